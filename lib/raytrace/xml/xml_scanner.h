// Checks that a text is well-formed XML, and finds where its parts stand.
//
// tinyxml2 builds the tree, but it forgives much that other XML tools refuse (a second root, unknown entities, bytes
// that are no text), explains a mistake by the name of an internal constant, and knows no columns. So every text passes
// this check first, and a text that does is one that tinyxml2 reads.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/item_chunks.h"

namespace raytrace {

// Behind a text there must be a '\0', as in std::string.

/// The first error of `text`: where it is not well-formed XML 1.0 in UTF-8, with or without byte order mark. Document
/// type declarations with declarations of their own, processing instructions, elements nested more than 64 deep and
/// tags of more than 64 attributes are refused too: no scene has them, and they are where XML readers get into trouble.
///
/// chunks: receives those of all elements that bear one of the names in `groups` and stand where groups do (root,
/// section, group), unless there is an error. Where they are cut may depend on whether there is more than one thread.
///
/// threads: how many may share the work on large groups; 0: all processors.
std::optional<TextError> find_xml_error(std::string_view text, std::span<const std::string_view> groups,
                                        std::vector<TextChunk>& chunks, int threads);

/// Where the elements (the '<' of their start tags) and the texts (their first character that is no white space) of a
/// well-formed text begin, in the order of the document: the order of a walk through its tree, parents before children.
/// White space between tags is no text; a CDATA section is one, and a comment ends one.
std::vector<std::size_t> find_nodes(std::string_view text);

/// How long the element is that a well-formed text starts with.
std::size_t element_length(std::string_view text);

/// What stands in the quotes of attributes and, without the white space before it, between tags, in the order of a
/// well-formed text without comments and character data.
std::vector<std::string_view> find_values(std::string_view text);

/// Where the attribute `name` stands in the start tag at `tag_offset` of a well-formed text.
std::size_t find_attribute(std::string_view text, std::size_t tag_offset, std::string_view name);

}  // namespace raytrace
