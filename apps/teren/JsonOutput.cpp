#include "apps/teren/JsonOutput.h"

#include <array>
#include <cstdio>
#include <iostream>

namespace teren {

void printJson(const OrderedJson& value) {
  std::cout << value.dump(2, ' ', false, OrderedJson::error_handler_t::replace) << '\n';
}

std::string hashDigits(std::uint64_t hash) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

}  // namespace teren
