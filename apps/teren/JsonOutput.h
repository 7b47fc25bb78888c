// How `teren` answers in JSON: keys in the order of the contract, indented, always valid UTF-8.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace teren {

using OrderedJson = nlohmann::ordered_json;

/// Writes the value and a line break to standard output; bytes that are not UTF-8 (file names may hold any)
/// become U+FFFD.
void printJson(const OrderedJson& value);

/// 16 lower-case hexadecimal digits.
std::string hashDigits(std::uint64_t hash);

}  // namespace teren
