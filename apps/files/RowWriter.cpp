#include "apps/files/RowWriter.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace teren {
namespace {

constexpr int kDecimals = 4;

}  // namespace

template <class... Arguments>
RowWriter& RowWriter::append(Arguments... number) {
  std::array<char, 400> digits{};  // the smallest and largest doubles have over 300
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number...).ptr;
  text_.append(digits.data(), end);
  return *this;
}

RowWriter& RowWriter::operator<<(std::size_t number) {
  return append(number);
}

RowWriter& RowWriter::shortest(float number) {
  return append(number == 0.0F ? 0.0F : number, std::chars_format::fixed);
}

RowWriter& RowWriter::shortest(double number) {
  return append(number == 0.0 ? 0.0 : number, std::chars_format::fixed);
}

RowWriter& RowWriter::rounded(double number) {
  return append(number, std::chars_format::fixed, kDecimals);
}

Result<void> RowWriter::flush() {
  const bool written = std::fwrite(text_.data(), 1, text_.size(), stream_) == text_.size();
  text_.clear();
  if (!written) return Error{std::string("the disk refuses: ") + std::strerror(errno)};
  return {};
}

}  // namespace teren
