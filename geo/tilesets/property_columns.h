// Columns of a property table of glTF, in its one buffer.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace oro {

// Appends what a column of texts, one for each row, needs to `bytes`, the buffer with number 0, and the views
// of it to `views`; gives the column's entry in the table. Source: Cesium, EXT_structural_metadata; OGC
// 22-025r4, 3D Metadata Specification, binary table format.
nlohmann::ordered_json texts_column(std::span<const std::string> texts, std::vector<std::uint8_t>& bytes,
                                    nlohmann::ordered_json& views);
// The same of numbers (FLOAT32).
nlohmann::ordered_json numbers_column(std::span<const float> numbers, std::vector<std::uint8_t>& bytes,
                                      nlohmann::ordered_json& views);

}  // namespace oro
