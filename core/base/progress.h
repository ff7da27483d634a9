// How far a long reading is.
#pragma once

#include <functional>
#include <string>

namespace oro {

// This is called with how far the work is, 0..1, and what it does, as in "reading N46E008.hgt", by the thread
// that does it.
using Progress = std::function<void(double share, const std::string& what)>;

}  // namespace oro
