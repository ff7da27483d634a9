#include "tests/support/object_store.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

namespace oro::test {
namespace {

// The value of a name in "a=1&b=2".
std::optional<std::string> field(const std::string& query, const std::string& name) {
    for (std::size_t begin = 0; begin <= query.size();) {
        const std::size_t end = std::min(query.find('&', begin), query.size());
        const std::string one = query.substr(begin, end - begin);
        if (one == name) return "";
        if (one.starts_with(name + "=")) return one.substr(name.size() + 1);
        begin = end + 1;
    }
    return std::nullopt;
}

std::string plain(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size()) {
            out += static_cast<char>(std::strtol(text.substr(i + 1, 2).c_str(), nullptr, 16));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

std::string etag_of(const std::string& bytes) {
    char text[40];
    std::snprintf(text, sizeof text, "\"%016zx\"", std::hash<std::string>{}(bytes));
    return text;
}

const std::string xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

}  // namespace

std::string s3_fault(const std::string& status, const std::string& code, const std::string& message) {
    return http_answer(
        status, "Content-Type: application/xml\r\n",
        xml_head + "<Error><Code>" + code + "</Code><Message>" + message + "</Message></Error>");
}

ObjectStore::ObjectStore()
    : server_([this](const LoopbackRequest& request, const LoopbackSend& send) { answer(request, send); }) {}

std::map<std::string, std::string> ObjectStore::objects() const {
    const std::lock_guard lock(mutex_);
    return objects_;
}

void ObjectStore::put(const std::string& name, const std::string& bytes) {
    const std::lock_guard lock(mutex_);
    objects_[name] = bytes;
}

std::size_t ObjectStore::open_uploads() const {
    const std::lock_guard lock(mutex_);
    return uploads_.size();
}

int ObjectStore::count(const std::string& method, const std::string& part_of_path) const {
    const std::vector<LoopbackRequest> all = requests();
    return static_cast<int>(std::ranges::count_if(all, [&](const LoopbackRequest& one) {
        return one.method == method && one.path.find(part_of_path) != std::string::npos;
    }));
}

std::vector<std::string> ObjectStore::environment() const {
    return {"no_proxy=127.0.0.1",
            "AWS_S3_ENDPOINT=" + server_.address().substr(std::string("http://").size()),
            "AWS_HTTPS=NO",
            "AWS_VIRTUAL_HOSTING=FALSE",
            "AWS_REGION=us-east-1",
            "AWS_ACCESS_KEY_ID=" + std::string(key_id),
            "AWS_SECRET_ACCESS_KEY=" + std::string(key),
            "AWS_SESSION_TOKEN",
            "AWS_PROFILE",
            "GDAL_HTTP_RETRY_DELAY=0.02"};
}

void ObjectStore::answer(const LoopbackRequest& request, const LoopbackSend& send) {
    if (fault_)
        if (const auto refusal = fault_(request)) return void(send(*refusal));
    const auto signature = request.headers.find("authorization");
    const std::string begin = "AWS4-HMAC-SHA256 Credential=" + std::string(key_id) + "/";
    if (signature == request.headers.end() || !signature->second.starts_with(begin) ||
        signature->second.find("Signature=") == std::string::npos)
        return void(send(s3_fault("403 Forbidden", "AccessDenied", "Access Denied")));
    const std::size_t question = request.path.find('?');
    const std::string name =
        plain(request.path.substr(1, question == std::string::npos ? question : question - 1));
    const std::string query = question == std::string::npos ? "" : request.path.substr(question + 1);
    const std::lock_guard lock(mutex_);
    send(answered(request, name, query));
}

std::string ObjectStore::answered(const LoopbackRequest& request, const std::string& name,
                                  const std::string& query) {
    if (request.method == "POST") return posted(request, name, query);
    if (request.method == "PUT") {
        if (const auto upload = field(query, "uploadId")) {
            const auto found = uploads_.find(*upload);
            if (found == uploads_.end()) return s3_fault("404 Not Found", "NoSuchUpload", "no such upload");
            found->second[std::atoi(field(query, "partNumber").value_or("0").c_str())] = request.body;
        } else {
            objects_[name] = request.body;
        }
        return http_answer("200 OK", "ETag: " + etag_of(request.body) + "\r\n", "");
    }
    if (request.method == "DELETE") {
        if (const auto upload = field(query, "uploadId"))
            uploads_.erase(*upload);
        else
            objects_.erase(name);
        return "HTTP/1.1 204 No Content\r\nConnection: close\r\n\r\n";
    }
    const bool is_bucket = name.find('/') == std::string::npos || name.find('/') + 1 == name.size();
    if (is_bucket) return listed(name.substr(0, name.find('/')), query);
    return got(request, name);
}

std::string ObjectStore::posted(const LoopbackRequest&, const std::string& name, const std::string& query) {
    if (field(query, "uploads")) {
        const std::string upload = "upload" + std::to_string(next_upload_++);
        uploads_[upload];
        return http_answer("200 OK", "",
                           xml_head + "<InitiateMultipartUploadResult><UploadId>" + upload +
                               "</UploadId></InitiateMultipartUploadResult>");
    }
    const auto found = uploads_.find(field(query, "uploadId").value_or(""));
    if (found == uploads_.end()) return s3_fault("404 Not Found", "NoSuchUpload", "no such upload");
    std::string all;
    for (const auto& [number, part] : found->second) all += part;
    objects_[name] = all;
    uploads_.erase(found);
    return http_answer("200 OK", "",
                       xml_head + "<CompleteMultipartUploadResult><ETag>" + etag_of(all) +
                           "</ETag></CompleteMultipartUploadResult>");
}

std::string ObjectStore::got(const LoopbackRequest& request, const std::string& name) {
    const auto found = objects_.find(name);
    if (found == objects_.end())
        return request.method == "HEAD" ? "HTTP/1.1 404 Not Found\r\nConnection: close\r\n\r\n"
                                        : s3_fault("404 Not Found", "NoSuchKey", "no such key");
    const std::string& bytes = found->second;
    const std::string headers =
        "ETag: " + etag_of(bytes) +
        "\r\nAccept-Ranges: bytes\r\nLast-Modified: Sat, 28 Nov 2026 18:00:00 GMT\r\n";
    if (request.method == "HEAD")
        return "HTTP/1.1 200 OK\r\nConnection: close\r\n" + headers +
               "Content-Length: " + std::to_string(bytes.size()) + "\r\n\r\n";
    const auto range = request.headers.find("range");
    std::size_t from = 0, to = 0;
    if (range == request.headers.end() || bytes.empty() ||
        std::sscanf(range->second.c_str(), "bytes=%zu-%zu", &from, &to) != 2 || from >= bytes.size())
        return http_answer("200 OK", headers, bytes);
    to = std::min(to, bytes.size() - 1);
    return http_answer("206 Partial Content",
                       headers + "Content-Range: bytes " + std::to_string(from) + "-" + std::to_string(to) +
                           "/" + std::to_string(bytes.size()) + "\r\n",
                       bytes.substr(from, to - from + 1));
}

std::string ObjectStore::listed(const std::string& bucket, const std::string& query) {
    const std::string begin = bucket + "/" + plain(field(query, "prefix").value_or(""));
    std::string text = xml_head + "<ListBucketResult><Name>" + bucket + "</Name><Prefix>" +
                       plain(field(query, "prefix").value_or("")) +
                       "</Prefix><IsTruncated>false</IsTruncated>";
    for (const auto& [name, bytes] : objects_)
        if (name.starts_with(begin) && name.find('/', begin.size()) == std::string::npos)
            text += "<Contents><Key>" + name.substr(bucket.size() + 1) +
                    "</Key><LastModified>2026-11-28T18:00:00.000Z</LastModified><ETag>" + etag_of(bytes) +
                    "</ETag><Size>" + std::to_string(bytes.size()) + "</Size></Contents>";
    return http_answer("200 OK", "Content-Type: application/xml\r\n", text + "</ListBucketResult>");
}

}  // namespace oro::test
