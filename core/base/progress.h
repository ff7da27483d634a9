// How far a long reading is.
#pragma once

#include <functional>
#include <string>

namespace oro {

// Told how far reading is, 0..1, from the calling thread.
using Progress = std::function<void(double share, const std::string& what)>;

}  // namespace oro
