// A layer of a vector file while it is read.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geo/files/foreign_text.h"
#include "geo/vectors/left_out.h"
#include "geo/vectors/vector_file.h"
#include "geo/vectors/vector_shapes.h"

namespace oro {

// Collects the features of a layer: fields get their numbers as they come up, and a feature that gives no
// shape leaves no record.
class LayerBuilder {
  public:
    LayerBuilder(std::string_view name, ShapeSplitter splitter) : splitter_(std::move(splitter)) {
        layer_.name = foreign_text(name);
    }

    // Adds what the next record says in a field; the first that says something counts, and "" is nothing.
    void say(std::string_view field, std::string_view text) {
        if (text.empty() || field.empty()) return;
        const std::size_t number = number_of(field);
        if (std::exchange(said_by_[number], number_) != number_)
            record_.push_back({number, foreign_text(text)});
    }
    // The number of a field, which the layer has from then on.
    std::size_t number_of(std::string_view field) {
        const std::string name = foreign_text(field);
        const auto [known, is_new] = numbers_.try_emplace(name, layer_.fields.size());
        if (is_new) {
            layer_.fields.push_back(name);
            said_by_.push_back(0);
        }
        return known->second;
    }
    // Where shapes of the next record go.
    [[nodiscard]] ShapeTarget target(HeightAbove heights, LeftOut& left_out) {
        return {heights, layer_.records.size(), &layer_.shapes, &left_out};
    }
    [[nodiscard]] ShapeSplitter& splitter() { return splitter_; }
    // Ends the record.
    void end_record() {
        if (layer_.shapes.size() > shapes_before_) layer_.records.push_back(std::move(record_));
        record_.clear();
        ++number_;
        shapes_before_ = layer_.shapes.size();
    }
    [[nodiscard]] bool has_shapes() const { return !layer_.shapes.empty(); }
    // The layer as a part of a file: its places are counted there.
    void finish(VectorFile& file) {
        file.ring_ends += splitter_.ring_ends();
        if (has_shapes()) file.layers.push_back(std::move(layer_));
    }

  private:
    ShapeSplitter splitter_;
    VectorLayer layer_;
    VectorRecord record_;
    std::unordered_map<std::string, std::size_t> numbers_;
    std::vector<std::size_t> said_by_;  // number of the last record that says something in a field
    std::size_t number_{1};             // of the record
    std::size_t shapes_before_{};
};

}  // namespace oro
