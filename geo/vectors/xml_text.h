// Elements of an XML file, by their names without a name space's prefix.
#pragma once

#include <cstddef>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace oro {

// An XML file as a tree. Entities that a file declares itself are not expanded, and nothing is fetched.
class XmlText {
  public:
    // Parses a text (UTF-8). Errors (a reason, without the file's name): the line and what is wrong there.
    static Result<XmlText> parse(std::string_view text);

    [[nodiscard]] pugi::xml_node root() const { return document_->document_element(); }
    // The byte of the text where an element stands; where its content begins, as far as that is one piece.
    [[nodiscard]] static std::size_t at(const pugi::xml_node& node);
    [[nodiscard]] std::size_t content_at(const pugi::xml_node& node) const;

  private:
    XmlText() = default;
    std::unique_ptr<std::string> bytes_;  // that the tree points into
    std::unique_ptr<pugi::xml_document> document_;
};

// The name of an element without its prefix; "" of what is no element.
std::string_view local_name(const pugi::xml_node& node);
// The first child element of that local name; none: null.
pugi::xml_node child_named(const pugi::xml_node& node, std::string_view name);
// All text directly in an element, without blanks around it.
std::string text_of(const pugi::xml_node& node);
// Whether an element holds other elements.
bool has_elements(const pugi::xml_node& node);
// The element after this one in the order of the file, down, across and up; null after the last within `top`.
pugi::xml_node next_in(const pugi::xml_node& top, const pugi::xml_node& node);

}  // namespace oro
