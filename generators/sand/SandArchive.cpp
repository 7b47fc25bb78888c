#include "generators/sand/SandArchive.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "teren/Hash.h"

#include "generators/sand/SandState.h"

namespace teren {
namespace {

constexpr std::uint32_t kVersion = 1;

struct Head {
  std::array<char, 8> magic{'T', 'E', 'R', 'E', 'N', 'S', 'N', 'D'};
  std::uint32_t version = kVersion;
  std::uint32_t sections = SandState::kSections;
  std::array<std::uint64_t, SandState::kSections> bytes{};
};
static_assert(sizeof(Head) == 16 + 8 * SandState::kSections);

/// Every byte counts, in order, and so does their number.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t hash = hashWith(0, bytes.size());
  for (; !bytes.empty(); bytes = bytes.subspan(std::min<std::size_t>(8, bytes.size()))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min(sizeof word, bytes.size()));
    hash = hashWith(hash, word);
  }
  return hash;
}

}  // namespace

std::vector<std::byte> archived(const Sandbox& sandbox) {
  const SandState state(sandbox);
  Head head;
  std::size_t size = sizeof head + sizeof(std::uint64_t);
  for (std::size_t i = 0; i < head.bytes.size(); ++i) {
    head.bytes[i] = state.sections()[i].size();
    size += state.sections()[i].size();
  }
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  const auto append = [&bytes](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  append(std::as_bytes(std::span(&head, 1)));
  for (const std::span<const std::byte> section : state.sections()) append(section);
  const std::uint64_t sum = checksum(bytes);
  append(std::as_bytes(std::span(&sum, 1)));
  return bytes;
}

Result<Sandbox> restored(std::span<const std::byte> bytes) {
  Head head;
  const Head expected;
  const std::size_t known = std::min(bytes.size(), sizeof head);
  if (known > 0) std::memcpy(&head, bytes.data(), known);
  if (known < expected.magic.size() || head.magic != expected.magic)
    return Error{"this is no sand of Teren's"};
  if (bytes.size() < 16) return Error{"the sand is cut short"};
  if (head.version != kVersion) {
    return Error{"the sand is of format " + std::to_string(head.version) +
                 ", but this program reads format " + std::to_string(kVersion)};
  }
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof head + sizeof sum) return Error{"the sand is cut short"};
  std::span<const std::byte> rest = bytes.subspan(sizeof head, bytes.size() - sizeof head - sizeof sum);
  SandState::Sections sections;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (head.bytes[i] > rest.size()) return Error{"the sand is cut short"};
    sections[i] = rest.first(head.bytes[i]);
    rest = rest.subspan(head.bytes[i]);
  }
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
  const bool whole = head.sections == expected.sections && rest.empty();
  if (!whole || sum != checksum(bytes.first(bytes.size() - sizeof sum))) return Error{"the sand is damaged"};
  Result<Sandbox> sandbox = SandState::sandboxOf(sections);
  if (!sandbox) return Error{"the sand is damaged: " + sandbox.error().message};
  return sandbox;
}

}  // namespace teren
