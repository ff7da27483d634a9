#include "geo/vectors/xml_text.h"

#include <algorithm>

namespace oro {
namespace {

std::string_view words_for(pugi::xml_parse_status status) {
    switch (status) {
        case pugi::status_out_of_memory:
            return "there is not enough memory for it";
        case pugi::status_end_element_mismatch:
            return "an element is closed that is not open, or one is never closed";
        case pugi::status_no_document_element:
            return "it has no element";
        case pugi::status_bad_comment:
        case pugi::status_bad_cdata:
        case pugi::status_bad_doctype:
        case pugi::status_bad_pi:
            return "a comment or declaration has no end";
        default:
            return "an element is not written as XML writes it";
    }
}

Error xml_fault(std::string_view text, std::size_t at, std::string_view what) {
    const auto line = 1 + std::ranges::count(text.substr(0, at), '\n');
    return {ErrorKind::failed, "",
            "is no whole XML: line " + std::to_string(line) + ": " + std::string(what)};
}

bool is_text(const pugi::xml_node& node) {
    return node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata;
}

}  // namespace

Result<XmlText> XmlText::parse(std::string_view text) {
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
        return xml_fault(text, zero, "a byte that is 0");
    XmlText xml;
    xml.bytes_ = std::make_unique<std::string>(text);
    xml.document_ = std::make_unique<pugi::xml_document>();
    constexpr unsigned int options = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_wconv_attribute;
    const pugi::xml_parse_result parsed = xml.document_->load_buffer_inplace(
        xml.bytes_->data(), xml.bytes_->size(), options, pugi::encoding_utf8);
    if (!parsed)
        return xml_fault(
            text, std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, parsed.offset)), text.size()),
            words_for(parsed.status));
    const pugi::xml_node root = xml.document_->document_element();
    for (pugi::xml_node other = root.next_sibling(); other; other = other.next_sibling()) {
        if (other.type() == pugi::node_element)
            return xml_fault(text, at(other), "a second element follows after the first one's end");
    }
    return xml;
}

std::size_t XmlText::at(const pugi::xml_node& node) {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, node.offset_debug()));
}

std::size_t XmlText::content_at(const pugi::xml_node& node) const {
    const pugi::xml_node only = node.first_child();
    if (!only || only.next_sibling() || !is_text(only)) return at(node);
    const char* const begin = only.value();
    const char* const all = bytes_->data();
    return begin >= all && begin < all + bytes_->size() ? static_cast<std::size_t>(begin - all) : at(node);
}

std::string_view local_name(const pugi::xml_node& node) {
    if (node.type() != pugi::node_element) return "";
    const std::string_view name = node.name();
    const std::size_t colon = name.rfind(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_named(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_node child : node.children()) {
        if (local_name(child) == name) return child;
    }
    return {};
}

std::string text_of(const pugi::xml_node& node) {
    std::string text;
    for (const pugi::xml_node child : node.children()) {
        if (is_text(child)) text += child.value();
    }
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

bool has_elements(const pugi::xml_node& node) {
    return std::ranges::any_of(
        node.children(), [](const pugi::xml_node& child) { return child.type() == pugi::node_element; });
}

pugi::xml_node next_in(const pugi::xml_node& top, const pugi::xml_node& node) {
    if (node.first_child()) return node.first_child();
    for (pugi::xml_node up = node; up && up != top; up = up.parent()) {
        if (up.next_sibling()) return up.next_sibling();
    }
    return {};
}

}  // namespace oro
