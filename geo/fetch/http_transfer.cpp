#include "geo/fetch/http_transfer.h"

#include <curl/curl.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

namespace oro {
namespace {

using Kind = TransferOutcome::Kind;

struct CloseTransfer {
    void operator()(CURL* transfer) const { curl_easy_cleanup(transfer); }
};
struct FreeHeaders {
    void operator()(curl_slist* headers) const { curl_slist_free_all(headers); }
};

constexpr long status_whole = 200, status_part = 206, status_no_such_range = 416;

bool start_curl() {
    static const bool started = curl_global_init(CURL_GLOBAL_DEFAULT) == CURLE_OK;
    return started;
}

bool is_status_to_retry(long status) {
    for (const long one : {408L, 425L, 429L, 500L, 502L, 503L, 504L})
        if (status == one) return true;
    return false;
}

bool is_fault_to_retry(CURLcode code) {
    for (const CURLcode one : {CURLE_COULDNT_RESOLVE_HOST, CURLE_COULDNT_CONNECT, CURLE_OPERATION_TIMEDOUT,
                               CURLE_GOT_NOTHING, CURLE_SEND_ERROR, CURLE_RECV_ERROR, CURLE_PARTIAL_FILE,
                               CURLE_SSL_CONNECT_ERROR, CURLE_HTTP2, CURLE_HTTP2_STREAM})
        if (code == one) return true;
    return false;
}

std::string status_words(long status) {
    const std::string words = "the server answers " + std::to_string(status);
    if (status == 401 || status == 403) return words + ": it does not give this file to everybody";
    if (status == 429) return words + ": too many requests";
    return words;
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
    std::uint64_t number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? ""
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// What the last answer says of the body that follows.
struct AnswerHead {
    std::string etag;
    std::string range;  // Content-Range
    std::optional<std::uint64_t> length;
    bool is_chunked{};
    bool is_http_1{};

    void take(std::string_view line) {
        if (line.starts_with("HTTP/")) {
            *this = {};
            is_http_1 = line.starts_with("HTTP/1");
            return;
        }
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) return;
        std::string name(line.substr(0, colon));
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
        const std::string_view value = trimmed(line.substr(colon + 1));
        if (name == "etag") etag = value;
        if (name == "content-range") range = value;
        if (name == "content-length") length = whole_number(value);
        if (name == "transfer-encoding") is_chunked = value.find("chunked") != std::string_view::npos;
    }
    // Two answers of one strong ETag have the same bytes (RFC 9110, 8.8.1); a weak one promises less.
    [[nodiscard]] std::string strong_etag() const {
        return etag.size() > 2 && etag.front() == '"' && etag.find_first_of("\r\n") == std::string::npos
                   ? etag
                   : "";
    }
};

// A transfer that goes on: libcurl hands it lines and bytes.
class Transfer {
  public:
    Transfer(const FetchAddress& address, PartFile& part, const TransferLimits& limits)
        : address_(address), shown_(address.shown()), part_(part), limits_(limits), curl_(curl_easy_init()) {}

    Result<TransferOutcome> run() {
        if (!curl_) return TransferOutcome{Kind::refused, "libcurl does not start", {}, false};
        set_up();
        const CURLcode code = curl_easy_perform(curl_.get());
        curl_easy_getinfo(curl_.get(), CURLINFO_RESPONSE_CODE, &status_);
        // An answer without a body.
        if (code == CURLE_OK && !has_begun_ && fault_.ok() && !stopped_) begin_body();
        if (!fault_.ok()) return fault_.error();
        TransferOutcome outcome = stopped_ ? *stopped_ : outcome_of(code);
        outcome.resumed = has_begun_ && status_ == status_part;
        return outcome;
    }

  private:
    template <class Value>
    void set(CURLoption option, Value value) {
        curl_easy_setopt(curl_.get(), option, value);
    }

    void set_up() {
        set(CURLOPT_URL, address_.url.c_str());
        set(CURLOPT_NOSIGNAL, 1L);
        set(CURLOPT_PROTOCOLS_STR, "http,https");
        set(CURLOPT_FOLLOWLOCATION, 1L);
        set(CURLOPT_MAXREDIRS, limits_.most_redirects);
        set(CURLOPT_REDIR_PROTOCOLS_STR, address_.url.starts_with("https:") ? "https" : "http,https");
        set(CURLOPT_CONNECTTIMEOUT_MS, std::lround(limits_.connect_s * 1000.0));
        set(CURLOPT_LOW_SPEED_LIMIT, limits_.slowest_bytes_per_s);
        set(CURLOPT_LOW_SPEED_TIME, std::max(1L, std::lround(limits_.stall_s)));
        set(CURLOPT_USERAGENT, limits_.program.c_str());
        set(CURLOPT_NETRC, static_cast<long>(CURL_NETRC_IGNORED));
        set(CURLOPT_ERRORBUFFER, words_);
        set(CURLOPT_HEADERFUNCTION, &Transfer::take_line);
        set(CURLOPT_HEADERDATA, this);
        set(CURLOPT_WRITEFUNCTION, &Transfer::take_bytes);
        set(CURLOPT_WRITEDATA, this);
        const std::string version = part_.version_of(shown_);
        if (version.empty()) return;
        from_ = part_.bytes();
        version_ = version;
        range_ = std::to_string(from_) + "-";
        set(CURLOPT_RANGE, range_.c_str());
        headers_.reset(curl_slist_append(nullptr, ("If-Range: " + version).c_str()));
        set(CURLOPT_HTTPHEADER, headers_.get());
    }

    // No exception passes through libcurl: without memory the program ends in order.
    static std::size_t take_line(char* bytes, std::size_t, std::size_t count, void* self) noexcept {
        static_cast<Transfer*>(self)->head_.take(std::string_view(bytes, count));
        return count;
    }

    static std::size_t take_bytes(char* bytes, std::size_t, std::size_t count, void* self) noexcept {
        Transfer& transfer = *static_cast<Transfer*>(self);
        return transfer.take(bytes, count) ? count : CURL_WRITEFUNC_ERROR;
    }

    bool take(const char* bytes, std::size_t count) {
        if (!has_begun_) {
            curl_easy_getinfo(curl_.get(), CURLINFO_RESPONSE_CODE, &status_);
            begin_body();
            if (stopped_ || !fault_.ok()) return false;
        }
        if (count > limits_.most_bytes || part_.bytes() > limits_.most_bytes - count) {
            stop(Kind::refused, too_large());
            return false;
        }
        fault_ = part_.append(bytes, count);
        return fault_.ok();
    }

    // Whether what follows is a file, or a part that fits to what is there. Else it is stopped.
    void begin_body() {
        if (status_ == status_part) {
            begin_part();
        } else if (status_ == status_whole) {
            begin_whole();
        } else {
            stop_by_status();
        }
        has_begun_ = !stopped_ && fault_.ok();
    }

    void begin_whole() {
        if (head_.is_http_1 && !head_.is_chunked && !head_.length)
            return stop(Kind::refused, "the server does not say where the file ends");
        if (head_.length && *head_.length > limits_.most_bytes) return stop(Kind::refused, too_large());
        fault_ = part_.begin(shown_, head_.strong_etag());
    }

    void begin_part() {
        // "bytes 100-199/200"; the last may be *.
        const std::string_view range = head_.range;
        const std::size_t dash = range.find('-'), slash = range.find('/');
        if (from_ == 0 || !range.starts_with("bytes ") || dash == std::string_view::npos ||
            slash == std::string_view::npos || slash < dash ||
            whole_number(range.substr(6, dash - 6)) != from_ ||
            (!head_.etag.empty() && head_.etag != version_))
            return stop(from_ == 0 ? Kind::refused : Kind::restart,
                        "the server sends another part than it was asked for");
        total_ = whole_number(range.substr(slash + 1));
        if (total_ && *total_ > limits_.most_bytes) stop(Kind::refused, too_large());
    }

    void stop_by_status() {
        if (status_ == status_no_such_range) return stop(Kind::restart, "the file on the server has changed");
        if (status_ == 204 || status_ == 404 || status_ == 410)
            return stop(Kind::not_there, status_words(status_));
        const bool is_key_wrong = !address_.key.empty() && (status_ == 401 || status_ == 403);
        stop(is_status_to_retry(status_) ? Kind::retry : Kind::refused,
             is_key_wrong ? "the server answers " + std::to_string(status_) + ": it does not take the key"
                          : status_words(status_));
        curl_off_t wait_s = 0;
        if (curl_easy_getinfo(curl_.get(), CURLINFO_RETRY_AFTER, &wait_s) == CURLE_OK && wait_s > 0)
            stopped_->retry_after_s = static_cast<double>(wait_s);
    }

    [[nodiscard]] TransferOutcome outcome_of(CURLcode code) const {
        if (code == CURLE_OK && (!total_ || part_.bytes() == *total_)) return {Kind::whole, "", {}, false};
        if (code == CURLE_OK) return {Kind::restart, "the server sent another size than it said", {}, false};
        const std::string words = address_.without_key(words_[0] != '\0' ? words_ : curl_easy_strerror(code));
        return {is_fault_to_retry(code) ? Kind::retry : Kind::refused, words, {}, false};
    }

    void stop(Kind kind, const std::string& reason) { stopped_ = TransferOutcome{kind, reason, {}, false}; }

    [[nodiscard]] std::string too_large() const {
        return "the file is larger than " + std::to_string(limits_.most_bytes) + " bytes";
    }

    const FetchAddress& address_;
    std::string shown_;
    PartFile& part_;
    const TransferLimits& limits_;
    std::unique_ptr<CURL, CloseTransfer> curl_;
    std::unique_ptr<curl_slist, FreeHeaders> headers_;
    char words_[CURL_ERROR_SIZE]{};
    AnswerHead head_;
    long status_{0};
    std::uint64_t from_{0};
    std::string version_, range_;
    std::optional<std::uint64_t> total_;
    bool has_begun_{false};
    std::optional<TransferOutcome> stopped_;
    Result<void> fault_;
};

}  // namespace

Result<TransferOutcome> transfer_file(const FetchAddress& address, PartFile& part,
                                      const TransferLimits& limits) {
    if (!start_curl()) return TransferOutcome{Kind::refused, "libcurl does not start", {}, false};
    return Transfer(address, part, limits).run();
}

}  // namespace oro
