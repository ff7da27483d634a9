// The way in which everything that the outside world does wrong is reported: a value or an Error, never an
// exception across a folder. Programmer mistakes assert instead.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

#include "core/base/one_line.h"

namespace oro {

// What went wrong, as the program's exit code tells it.
enum class ErrorKind {
    failed = 1,     // a file, a disk, a driver: the world did not do what was asked
    usage = 2,      // an argument that cannot mean anything
    no_data = 3,    // nothing to draw in the region
    no_device = 4,  // no suitable GPU
};

// One line for a person: "where: what". `where` is a file with its place, an option with its value, or a
// call.
struct Error {
    ErrorKind kind{ErrorKind::failed};
    std::string where;
    std::string what;

    [[nodiscard]] std::string line() const {
        return where.empty() ? one_line(what) : one_line(where) + ": " + one_line(what);
    }
};

// A T, or the Error that stood in its way. Asking for the one that is not there is a programmer's mistake.
//     Result<Region> opened = open_region(request);
//     if (!opened.ok()) return opened.error();
//     const Region& region = *opened;
// or, in one line:
//     ORO_TRY(const Region region, open_region(request));
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return content_.index() == 0; }
    explicit operator bool() const { return ok(); }
    T& value() & { return assert(ok()), *std::get_if<0>(&content_); }
    const T& value() const& { return assert(ok()), *std::get_if<0>(&content_); }
    T&& value() && { return assert(ok()), std::move(*std::get_if<0>(&content_)); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }
    [[nodiscard]] const Error& error() const { return assert(!ok()), *std::get_if<1>(&content_); }

  private:
    std::variant<T, Error> content_;
};

template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : error_(std::move(error)), failed_(true) {}

    [[nodiscard]] bool ok() const { return !failed_; }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const { return assert(failed_), error_; }

  private:
    Error error_;
    bool failed_{false};
};

}  // namespace oro

#define ORO_JOIN_(a, b) a##b
#define ORO_JOIN(a, b) ORO_JOIN_(a, b)
// ORO_TRY(auto x, f()): x is f()'s value, or the enclosing function returns f()'s error.
#define ORO_TRY(declaration, expression) ORO_TRY_AS(ORO_JOIN(oro_result_, __LINE__), declaration, expression)
#define ORO_TRY_AS(name, declaration, expression) \
    auto name = (expression);                     \
    if (!name.ok()) return name.error();          \
    declaration = std::move(name).value()
// ORO_CHECK(f()): for a Result<void>.
#define ORO_CHECK(expression) \
    if (auto oro_checked = (expression); !oro_checked.ok()) return oro_checked.error()
