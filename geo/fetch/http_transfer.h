// One request of a file by HTTP, into a part file. The only code that uses a network.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/fetch/fetch_address.h"
#include "geo/fetch/part_file.h"

namespace oro {

// What a server may cost.
struct TransferLimits {
    std::uint64_t most_bytes{std::uint64_t{1} << 30U};  // of a file
    double connect_s{20.0};                             // until there is a connection
    double stall_s{30.0};                               // so long it may send less than slowest_bytes_per_s
    long slowest_bytes_per_s{1000};
    long most_redirects{5};           // to http and https alone; from https to https alone
    std::string program{"Orograph"};  // as the server is told
};

// What one request came to.
struct TransferOutcome {
    enum class Kind {
        whole,      // the part holds all bytes of the file
        not_there,  // the server has no such file (404, 410), or nothing there (204)
        restart,    // what the part holds is of no use any more: ask again for all
        retry,      // may go well later
        refused,    // will not go well later
    };
    Kind kind{Kind::refused};
    std::string reason;                   // for people, of the last three
    std::optional<double> retry_after_s;  // what the server asks to wait
    bool resumed{};                       // the part went on from what it held before
};

// Asks for the file at the address, and adds what comes to the part: from where that ends if it is
// of the version that the server still has (Range and If-Range with its ETag), else from the beginning. It
// takes no password from an address and no cookies, and sends none. What the part remembers of the address,
// and the reason, are without its key. From any thread. Errors: the part cannot be written.
Result<TransferOutcome> transfer_file(const FetchAddress& address, PartFile& part,
                                      const TransferLimits& limits);

}  // namespace oro
