#include "geo/fetch/fetch_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

namespace oro {
namespace {

using Kind = TransferOutcome::Kind;

std::string seconds_text(double wait_s) {
    return std::to_string(std::llround(wait_s)) + " s";
}

// Before retry `number` (from 0). Up to a quarter more, so that the parts of one run do not all come back at
// once.
double wait_before_s(int number, const std::string& url, const FetchLimits& limits) {
    const double share = static_cast<double>((std::hash<std::string>{}(url) >> 8U) % 256U) / 1024.0;
    return std::min(limits.first_wait_s * std::ldexp(1.0, number) * (1.0 + share), limits.most_wait_s);
}

// Waits as the server asks, or longer each time. Errors: it asks for too long.
Result<void> wait_for(const TransferOutcome& outcome, int number, const std::string& url,
                      const FetchLimits& limits) {
    const double asked_s = outcome.retry_after_s.value_or(0.0);
    if (asked_s > limits.most_wait_s)
        return Error{ErrorKind::failed, url,
                     outcome.reason + "; it asks to wait " + seconds_text(asked_s) + ", and at most " +
                         seconds_text(limits.most_wait_s) + " are waited"};
    std::this_thread::sleep_for(
        std::chrono::duration<double>(std::max(asked_s, wait_before_s(number, url, limits))));
    return {};
}

Error given_up(const std::string& url, const TransferOutcome& outcome, int requests) {
    return {ErrorKind::failed, url,
            outcome.reason + (requests > 1 ? " (after " + std::to_string(requests) + " requests)" : "")};
}

// Asks until the part is whole and passes the check, or the server has no such file.
Result<FetchedFile> fill(PartFile& part, const FetchAddress& address, const FetchLimits& limits,
                         const CheckContent& check) {
    FetchedFile fetched;
    const std::string url = address.shown();
    for (int retry = 0;; ++retry) {
        ORO_TRY(const TransferOutcome outcome, transfer_file(address, part, limits.transfer));
        ++fetched.requests;
        const bool may_retry = retry < limits.retries;
        if (outcome.kind == Kind::whole) {
            const Result<void> checked = check(part.path());
            if (checked.ok()) break;
            ORO_CHECK(part.begin(url, ""));
            if (!outcome.resumed || !may_retry) return checked.error();
            continue;
        }
        if (outcome.kind == Kind::not_there) {
            ORO_CHECK(part.begin(url, ""));
            return fetched;
        }
        if (outcome.kind == Kind::restart) ORO_CHECK(part.begin(url, ""));
        if (!may_retry || outcome.kind == Kind::refused) return given_up(url, outcome, fetched.requests);
        if (outcome.kind == Kind::retry) ORO_CHECK(wait_for(outcome, retry, url, limits));
    }
    fetched.is_there = true;
    fetched.bytes = part.bytes();
    return fetched;
}

}  // namespace

std::optional<FetchedFile> fetched_meanwhile(const std::string& path, PartFile& part,
                                             const FetchLimits& limits) {
    if (limits.share_wait_s <= 0.0) return std::nullopt;
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(path, none);
    if (none) return std::nullopt;
    part.discard();
    return FetchedFile{true, bytes, 0};
}

Result<FetchedFile> fetch_file(const FetchAddress& address, const std::string& path,
                               const FetchLimits& limits, const CheckContent& check) {
    ORO_TRY(PartFile part, PartFile::open(path, limits.share_wait_s));
    if (const auto meanwhile = fetched_meanwhile(path, part, limits)) return *meanwhile;
    ORO_TRY(const FetchedFile fetched, fill(part, address, limits, check));
    if (fetched.is_there) ORO_CHECK(part.commit());
    return fetched;
}

Result<std::string> fetch_text(const FetchAddress& address, const std::string& path,
                               const FetchLimits& limits, const CheckContent& check) {
    ORO_TRY(PartFile part, PartFile::open(path));
    ORO_TRY(const FetchedFile fetched, fill(part, address, limits, check));
    if (!fetched.is_there) return Error{ErrorKind::failed, address.shown(), "the server has no such file"};
    std::ifstream stream(part.path(), std::ios::binary);
    std::string text(fetched.bytes, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (static_cast<std::uint64_t>(stream.gcount()) != fetched.bytes)
        return Error{ErrorKind::failed, part.path(), "cannot be read"};
    part.discard();
    return text;
}

}  // namespace oro
