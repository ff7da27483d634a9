// A store of objects on the loopback address that speaks as much of S3 as GDAL's /vsis3/ does: objects in one
// part and in several, their heads, parts of them, lists, removals; and that fails as a test wants it to.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/loopback_server.h"

namespace oro::test {

class ObjectStore {
  public:
    // The answer to a request that shall not be served as it should be; nothing where it shall.
    using Fault = std::function<std::optional<std::string>(const LoopbackRequest& request)>;

    ObjectStore();

    // Before any request.
    void fail(Fault fault) { fault_ = std::move(fault); }
    // By bucket and name: "bucket/folder/name".
    [[nodiscard]] std::map<std::string, std::string> objects() const;
    void put(const std::string& name, const std::string& bytes);
    // Uploads of several parts that were begun, and neither finished nor given up.
    [[nodiscard]] std::size_t open_uploads() const;
    [[nodiscard]] std::vector<LoopbackRequest> requests() const { return server_.requests(); }
    // How many requests had this method, and this in their path.
    [[nodiscard]] int count(const std::string& method, const std::string& part_of_path = "") const;

    // What a user of it has in the environment.
    [[nodiscard]] std::vector<std::string> environment() const;
    static constexpr const char* key_id = "ORO0TEST0KEY0ID00000";
    static constexpr const char* key = "not/a/real/secret/key/of/anybody/00000000";

  private:
    void answer(const LoopbackRequest& request, const LoopbackSend& send);
    std::string answered(const LoopbackRequest& request, const std::string& name, const std::string& query);
    std::string posted(const LoopbackRequest& request, const std::string& name, const std::string& query);
    std::string got(const LoopbackRequest& request, const std::string& name);
    std::string listed(const std::string& bucket, const std::string& query);

    mutable std::mutex mutex_;
    Fault fault_;
    std::map<std::string, std::string> objects_;
    std::map<std::string, std::map<int, std::string>> uploads_;  // by their numbers, their parts
    int next_upload_{1};
    LoopbackServer server_;
};

// An answer of S3's to what it refuses.
std::string s3_fault(const std::string& status, const std::string& code, const std::string& message);

}  // namespace oro::test
