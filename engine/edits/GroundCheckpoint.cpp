#include "edits/GroundCheckpoint.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "teren/Hash.h"
#include "teren/Position.h"

namespace teren {

namespace {

constexpr int kMostIntervals = 512;  // of a world

std::uint64_t hashOf(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return std::bit_cast<std::uint64_t>(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<std::uint64_t>(*whole);
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? 1 : 0;
  return hashText(*std::get_if<std::string>(&value));
}

void add(std::string& text, std::uint64_t word, int bytes) {
  for (int byte = 0; byte < bytes; ++byte) text += static_cast<char>(word >> (8 * byte));
}

/// What is left of a text.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}
  bool has(std::uint64_t bytes) const noexcept { return rest_.size() >= bytes; }
  bool isOver() const noexcept { return rest_.empty(); }
  /// It has so many bytes.
  std::uint64_t word(int bytes) noexcept {
    std::uint64_t word = 0;
    for (int byte = 0; byte < bytes; ++byte) {
      word |= std::uint64_t{static_cast<std::uint8_t>(rest_[static_cast<std::size_t>(byte)])} << (8 * byte);
    }
    rest_.remove_prefix(static_cast<std::size_t>(bytes));
    return word;
  }
  /// Likewise.
  void skip(std::uint64_t bytes) noexcept { rest_.remove_prefix(static_cast<std::size_t>(bytes)); }
  float height() noexcept { return std::bit_cast<float>(static_cast<std::uint32_t>(word(4))); }

 private:
  std::string_view rest_;
};

constexpr std::uint64_t kSampleBytes = 12, kPatchBytes = 20;

/// One patch's samples; false where they are none.
bool readPatch(Reader& reader, std::uint64_t samples, GroundOverrides::Patch& patch) {
  const auto side = static_cast<std::uint64_t>(patch.now.columns());
  for (std::int64_t before = -1; samples > 0; --samples) {
    const std::uint64_t place = reader.word(4);
    const float now = reader.height(), own = reader.height();
    const bool isGood = place<side * side&& static_cast<std::int64_t>(place)> before && std::isfinite(now) &&
                        std::isfinite(own) && now != own;
    if (!isGood) return false;
    patch.now(static_cast<int>(place % side), static_cast<int>(place / side)) = now;
    patch.own(static_cast<int>(place % side), static_cast<int>(place / side)) = own;
    before = static_cast<std::int64_t>(place);
  }
  return true;
}

/// None where they are cut off.
std::optional<std::uint64_t> countPatches(Reader reader) {
  std::uint64_t count = 0;
  for (; !reader.isOver(); ++count) {
    if (!reader.has(kPatchBytes)) return std::nullopt;
    reader.skip(kPatchBytes - 4);
    const std::uint64_t bytes = reader.word(4) * kSampleBytes;
    if (!reader.has(bytes)) return std::nullopt;
    reader.skip(bytes);
  }
  return count;
}

bool isInWorld(std::int64_t patch) {
  return -kMaxPatch <= patch && patch <= kMaxPatch;
}

}  // namespace

EditListMark EditListMark::ofNone(std::uint64_t worldHash) noexcept {
  return {0, hashWith(hashText("teren ground 2"), worldHash)};
}

EditListMark EditListMark::followedBy(const Edit& edit, std::string_view version) const noexcept {
  std::uint64_t hash = hashWith(hashWith(checksum, hashText(edit.kind)), hashText(version));
  for (const double number : {edit.x, edit.y, edit.z, edit.size, edit.depth}) {
    hash = hashWith(hash, std::bit_cast<std::uint64_t>(number));
  }
  hash = hashWith(hashWith(hash, edit.seed), edit.steps);
  for (const auto& [name, value] : edit.parameters) {
    hash = hashWith(hashWith(hashWith(hash, hashText(name)), value.index()), hashOf(value));
  }
  return {edits + 1, hashWith(hash, edit.parameters.size())};
}

std::string GroundCheckpoint::text() const {
  std::string text;
  add(text, static_cast<std::uint64_t>(overrides_.intervals()), 4);
  add(text, ended_.surfaces, 8);
  add(text, std::bit_cast<std::uint64_t>(ended_.error), 8);
  add(text, std::bit_cast<std::uint64_t>(ended_.absolute), 8);
  for (const auto& [key, held] : overrides_.patches()) {
    const auto now = held.patch->now.samples(), own = held.patch->own.samples();
    const auto count = std::count_if(now.begin(), now.end(), [](float one) { return !std::isnan(one); });
    if (count == 0) continue;
    add(text, static_cast<std::uint64_t>(key.first), 8);
    add(text, static_cast<std::uint64_t>(key.second), 8);
    add(text, static_cast<std::uint64_t>(count), 4);
    for (std::size_t place = 0; place < now.size(); ++place) {
      if (std::isnan(now[place])) continue;
      add(text, place, 4);
      add(text, std::bit_cast<std::uint32_t>(now[place]), 4);
      add(text, std::bit_cast<std::uint32_t>(own[place]), 4);
    }
  }
  return text;
}

Result<GroundCheckpoint> GroundCheckpoint::read(const EditListMark& mark, std::string_view text) {
  const Error none{"it is not what was written"};
  Reader reader(text);
  if (!reader.has(28)) return none;
  const std::uint64_t intervals = reader.word(4);
  if (!std::has_single_bit(intervals) || intervals > kMostIntervals) return none;
  EndedSurfaces ended{.surfaces = reader.word(8)};
  ended.error = std::bit_cast<double>(reader.word(8));
  ended.absolute = std::bit_cast<double>(reader.word(8));
  if (!std::isfinite(ended.error) || !(std::isfinite(ended.absolute) && ended.absolute >= 0.0)) return none;
  const std::optional<std::uint64_t> patches = countPatches(reader);
  if (!patches || *patches > kMostBytes / (intervals * intervals * 2 * sizeof(float))) return none;
  GroundOverrides overrides(static_cast<int>(intervals));
  GroundOverrides::Key before{std::numeric_limits<std::int64_t>::min(),
                              std::numeric_limits<std::int64_t>::min()};
  while (!reader.isOver()) {
    const auto j = static_cast<std::int64_t>(reader.word(8)), i = static_cast<std::int64_t>(reader.word(8));
    const std::uint64_t samples = reader.word(4);
    const GroundOverrides::Key key{j, i};
    if (samples == 0 || !(before < key) || !isInWorld(j) || !isInWorld(i)) return none;
    if (!readPatch(reader, samples, overrides.add(key))) return none;
    before = key;
  }
  return GroundCheckpoint(mark, ended, overrides.share());
}

}  // namespace teren
