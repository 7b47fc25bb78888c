// Text from outside (a command line, a file, a plugin) as it may appear in a one-sentence message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace teren {

/// The most bytes of foreign text that a message shows where nothing else is asked.
inline constexpr std::size_t kQuoteBytes = 80;

/// `text` on one line: control characters and bytes that are not UTF-8 become '?', and what is longer than
/// `bytes` ends in "..." after at most so many (cut between characters). Costs O(bytes), however long the
/// text.
std::string shortened(std::string_view text, std::size_t bytes = kQuoteBytes);

/// shortened(text) between quotation marks.
std::string inQuotes(std::string_view text);

}  // namespace teren
