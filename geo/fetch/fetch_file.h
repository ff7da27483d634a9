// A file from a server: whole or not there, tried again where that may help.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/fetch/fetch_address.h"
#include "geo/fetch/http_transfer.h"
#include "geo/fetch/part_file.h"

namespace oro {

struct FetchLimits {
    TransferLimits transfer;
    int retries{4};            // further requests after one that may go well later
    double first_wait_s{1.0};  // before the first of these; twice as long before each next
    double most_wait_s{60.0};  // the longest wait; a server that asks for a longer one is given up
    double share_wait_s{};     // so long another program may be fetching the same file; it is then there
};

struct FetchedFile {
    bool is_there{};        // false: the server says that it has no such file
    std::uint64_t bytes{};  // of the file
    int requests{};         // that it took
};

// Whether a file is what it should be: it is called with the path of the part, before it gets its name.
using CheckContent = std::function<Result<void>(const std::string& part)>;

// Writes what is at the address as the file `path`, which must not be there; a part of it that an earlier run
// left is gone on with. What does not pass the check is removed; where it had been put together from parts,
// it is asked for once more as a whole. From any thread. Errors: those of the server, with the address and
// its words, after all retries; those of the check; those of writing.
Result<FetchedFile> fetch_file(const FetchAddress& address, const std::string& path,
                               const FetchLimits& limits, const CheckContent& check);

// What is to be said where another program has finished the file while this one waited for its part; nothing
// where the file is not there. Part is the file's.
std::optional<FetchedFile> fetched_meanwhile(const std::string& path, PartFile& part,
                                             const FetchLimits& limits);

// Takes what is at the address into memory. While it comes it lies beside `path`, as the part of that file
// would; nothing of it stays there. The rest as with fetch_file(). Errors: the server has no such file, too.
Result<std::string> fetch_text(const FetchAddress& address, const std::string& path,
                               const FetchLimits& limits, const CheckContent& check);

}  // namespace oro
