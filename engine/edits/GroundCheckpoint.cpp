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

constexpr std::uint64_t kSampleBytes = 12, kLooseBytes = 8, kPatchBytes = 20;

/// The places of a patch's samples, in their order, and by read(x, y) what is said of each; false where one
/// of them is none.
template <class Read>
bool readPatch(Reader& reader, std::uint64_t samples, std::uint64_t side, const Read& read) {
  for (std::uint64_t next = 0; samples > 0; --samples) {
    const std::uint64_t place = reader.word(4);
    if (place < next || place >= side * side) return false;
    if (!read(static_cast<int>(place % side), static_cast<int>(place / side))) return false;
    next = place + 1;
  }
  return true;
}

/// Goes over so many patches, or all that are left; none where they are cut off.
std::optional<std::uint64_t> skipPatches(Reader& reader, std::uint64_t sampleBytes,
                                         std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
  std::uint64_t count = 0;
  for (; count < most && !reader.isOver(); ++count) {
    if (!reader.has(kPatchBytes)) return std::nullopt;
    reader.skip(kPatchBytes - 4);
    const std::uint64_t bytes = reader.word(4) * sampleBytes;
    if (!reader.has(bytes)) return std::nullopt;
    reader.skip(bytes);
  }
  return count;
}

/// Writes where a patch lies and its samples, those of which `has` says so by `write`, if there are any.
template <class Has, class Write>
void addPatch(std::string& text, const GroundOverrides::Key& key, std::size_t samples, const Has& has,
              const Write& write) {
  std::uint64_t count = 0;
  for (std::size_t place = 0; place < samples; ++place) count += has(place);
  if (count == 0) return;
  add(text, static_cast<std::uint64_t>(key.first), 8);
  add(text, static_cast<std::uint64_t>(key.second), 8);
  add(text, count, 4);
  for (std::size_t place = 0; place < samples; ++place) {
    if (!has(place)) continue;
    add(text, place, 4);
    write(place);
  }
}

void addFloat(std::string& text, float number) {
  add(text, std::bit_cast<std::uint32_t>(number), 4);
}

bool isInWorld(std::int64_t patch) {
  return -kMaxPatch <= patch && patch <= kMaxPatch;
}

}  // namespace

EditListMark EditListMark::ofNone(std::uint64_t worldHash) noexcept {
  return {0, hashWith(hashText("teren ground 3"), worldHash)};
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
  std::string text, heights;
  std::uint64_t patches = 0;
  for (const auto& [key, held] : overrides_.patches()) {
    const auto now = held.patch->now.samples(), own = held.patch->own.samples();
    const std::size_t before = heights.size();
    addPatch(
        heights, key, now.size(), [&](std::size_t place) { return !std::isnan(now[place]); },
        [&](std::size_t place) {
          addFloat(heights, now[place]);
          addFloat(heights, own[place]);
        });
    if (heights.size() > before) ++patches;
  }
  add(text, static_cast<std::uint64_t>(overrides_.intervals()), 4);
  add(text, ended_.surfaces, 8);
  add(text, std::bit_cast<std::uint64_t>(ended_.error), 8);
  add(text, std::bit_cast<std::uint64_t>(ended_.absolute), 8);
  add(text, patches, 8);
  text += heights;
  for (const auto& [key, patch] : loose_.patches()) {
    const auto depths = patch->samples();
    addPatch(
        text, key, depths.size(), [&](std::size_t place) { return depths[place] > 0.0F; },
        [&](std::size_t place) { addFloat(text, depths[place]); });
  }
  return text;
}

Result<GroundCheckpoint> GroundCheckpoint::read(const EditListMark& mark, std::string_view text) {
  const Error none{"it is not what was written"};
  Reader reader(text);
  if (!reader.has(36)) return none;
  const std::uint64_t intervals = reader.word(4);
  if (!std::has_single_bit(intervals) || intervals > kMostIntervals) return none;
  EndedSurfaces ended{.surfaces = reader.word(8)};
  ended.error = std::bit_cast<double>(reader.word(8));
  ended.absolute = std::bit_cast<double>(reader.word(8));
  if (!std::isfinite(ended.error) || !(std::isfinite(ended.absolute) && ended.absolute >= 0.0)) return none;
  const std::uint64_t patches = reader.word(8);
  Reader ahead = reader;
  const std::optional<std::uint64_t> changed = skipPatches(ahead, kSampleBytes, patches);
  if (!changed || *changed != patches) return none;
  const std::optional<std::uint64_t> withLoose = skipPatches(ahead, kLooseBytes);
  const std::uint64_t mostMaps = kMostBytes / (intervals * intervals * sizeof(float));
  if (!withLoose || *changed > mostMaps / 2 || *withLoose > mostMaps - 2 * *changed) return none;

  const auto side = static_cast<int>(intervals);
  GroundOverrides overrides(side);
  LooseLayer loose(side);
  const auto readAll = [&](std::uint64_t count, const auto& readOne) {
    GroundOverrides::Key before{std::numeric_limits<std::int64_t>::min(),
                                std::numeric_limits<std::int64_t>::min()};
    for (; count > 0; --count) {
      const auto j = static_cast<std::int64_t>(reader.word(8)), i = static_cast<std::int64_t>(reader.word(8));
      const std::uint64_t samples = reader.word(4);
      const GroundOverrides::Key key{j, i};
      if (samples == 0 || !(before < key) || !isInWorld(j) || !isInWorld(i)) return false;
      if (!readOne(key, samples)) return false;
      before = key;
    }
    return true;
  };
  const auto readChanged = [&](const GroundOverrides::Key& key, std::uint64_t samples) {
    GroundOverrides::Patch& patch = overrides.add(key);
    return readPatch(reader, samples, intervals, [&](int x, int y) {
      const float now = patch.now(x, y) = reader.height(), own = patch.own(x, y) = reader.height();
      return std::isfinite(now) && std::isfinite(own) && now != own;
    });
  };
  const auto readLoose = [&](const GroundOverrides::Key& key, std::uint64_t samples) {
    HeightMap depths(side, side);
    const bool isGood = readPatch(reader, samples, intervals, [&](int x, int y) {
      const float depth = depths(x, y) = reader.height();
      return std::isfinite(depth) && depth > 0.0F;
    });
    if (isGood) loose.add(key, std::move(depths));
    return isGood;
  };
  if (!readAll(*changed, readChanged) || !readAll(*withLoose, readLoose)) return none;
  return GroundCheckpoint(mark, ended, overrides.share(), std::move(loose));
}

}  // namespace teren
