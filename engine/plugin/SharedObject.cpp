#include "plugin/SharedObject.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <elf.h>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "teren/Plugin.h"

namespace teren {
namespace {

#if defined(__x86_64__)
constexpr std::uint16_t kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr std::uint16_t kMachine = EM_AARCH64;
#else
#error "Name this machine's ELF number here."
#endif

constexpr std::uint64_t kMostDynamicBytes = std::uint64_t{1} << 20;

/// Reads parts of a file; false where a part does not lie wholly inside it.
class FileReader {
 public:
  FileReader(const std::filesystem::path& file, std::uint64_t size)
      : stream_(file, std::ios::binary), size_(size) {}

  bool opened() const { return stream_.is_open(); }
  bool contains(std::uint64_t offset, std::uint64_t length) const {
    return offset <= size_ && length <= size_ - offset;
  }
  bool read(std::uint64_t offset, void* to, std::uint64_t length) {
    if (!contains(offset, length)) return false;
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(length));
    return stream_.good();
  }
  /// The zero-ended text at an offset, at most 255 bytes of it.
  std::string text(std::uint64_t offset) {
    char bytes[256] = {};
    if (offset >= size_) return {};
    const std::uint64_t length = std::min<std::uint64_t>(sizeof(bytes) - 1, size_ - offset);
    return read(offset, bytes, length) ? std::string(bytes) : std::string();
  }

 private:
  std::ifstream stream_;
  std::uint64_t size_;
};

Error cutShort() {
  return {"it is cut short: its headers speak of more than the file holds"};
}

Result<void> checkHeader(const Elf64_Ehdr& header) {
  const bool sameForm = header.e_ident[EI_CLASS] == ELFCLASS64 && header.e_ident[EI_DATA] == ELFDATA2LSB;
  if (!sameForm || header.e_machine != kMachine) return Error{"it was built for another kind of machine"};
  if (header.e_type != ET_DYN) return Error{"it is an ELF file but not a shared library"};
  if (header.e_phentsize != sizeof(Elf64_Phdr)) return Error{"its ELF header is damaged"};
  return {};
}

/// Part of a file's bytes as a type of theirs; a copy, for they may lie at any address.
template <class Part>
bool copyPart(std::span<const char> file, std::uint64_t offset, Part& part) noexcept {
  if (offset > file.size() || sizeof(Part) > file.size() - offset) return false;
  std::memcpy(&part, file.data() + offset, sizeof(Part));
  return true;
}

constexpr std::uint64_t kNone = ~std::uint64_t{0};

/// Where in the file lies what the loader maps at an address; kNone where nothing is mapped.
std::uint64_t fileOffset(const std::vector<Elf64_Phdr>& segments, std::uint64_t address) {
  for (const Elf64_Phdr& segment : segments) {
    if (segment.p_type != PT_LOAD || address < segment.p_vaddr) continue;
    if (address - segment.p_vaddr < segment.p_filesz) return segment.p_offset + (address - segment.p_vaddr);
  }
  return kNone;
}

/// The names of the libraries the file needs, as far as they can be read.
std::vector<std::string> neededLibraries(FileReader& reader, const std::vector<Elf64_Phdr>& segments) {
  std::vector<Elf64_Dyn> entries;
  for (const Elf64_Phdr& segment : segments) {
    if (segment.p_type != PT_DYNAMIC || segment.p_filesz > kMostDynamicBytes) continue;
    entries.resize(segment.p_filesz / sizeof(Elf64_Dyn));
    if (!reader.read(segment.p_offset, entries.data(), entries.size() * sizeof(Elf64_Dyn))) return {};
  }
  std::uint64_t names = kNone;
  for (const Elf64_Dyn& entry : entries) {
    if (entry.d_tag == DT_STRTAB) names = fileOffset(segments, entry.d_un.d_ptr);
  }
  std::vector<std::string> libraries;
  if (names == kNone) return libraries;
  for (const Elf64_Dyn& entry : entries) {
    if (entry.d_tag == DT_NULL) break;
    if (entry.d_tag == DT_NEEDED) libraries.push_back(reader.text(names + entry.d_un.d_val));
  }
  return libraries;
}

Result<void> checkSanitizers(const std::vector<std::string>& libraries) {
  for (const std::string& library : libraries) {
    const bool address = kSanitizerWord != 1 && library.starts_with("libasan.");
    const bool thread = kSanitizerWord != 2 && library.starts_with("libtsan.");
    if (address || thread) {
      return Error{std::string("it was built with the ") + (address ? "address" : "thread") + " sanitizer (" +
                   library + ") but the engine was not"};
    }
  }
  return {};
}

}  // namespace

Result<void> checkSharedObject(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return Error{"it is not a regular file"};
  const std::uint64_t size = std::filesystem::file_size(file, error);
  FileReader reader(file, error ? 0 : size);
  if (error || !reader.opened()) return Error{"it cannot be read"};

  Elf64_Ehdr header{};
  if (size == 0) return Error{"it is empty"};
  if (!reader.read(0, &header, std::min<std::uint64_t>(size, SELFMAG))) return Error{"it cannot be read"};
  if (std::memcmp(header.e_ident, ELFMAG, std::min<std::uint64_t>(size, SELFMAG)) != 0) {
    return Error{"it is not a shared library (no ELF file)"};
  }
  if (!reader.read(0, &header, sizeof(header))) return cutShort();
  if (Result<void> checked = checkHeader(header); !checked) return checked;

  std::vector<Elf64_Phdr> segments(header.e_phnum);
  const std::uint64_t sectionBytes = std::uint64_t{header.e_shnum} * header.e_shentsize;
  if (!reader.contains(header.e_shoff, sectionBytes)) return cutShort();
  if (!reader.read(header.e_phoff, segments.data(), segments.size() * sizeof(Elf64_Phdr))) return cutShort();
  for (const Elf64_Phdr& segment : segments) {
    if (!reader.contains(segment.p_offset, segment.p_filesz)) return cutShort();
  }
  return checkSanitizers(neededLibraries(reader, segments));
}

bool makeUniqueSymbolsWeak(std::span<char> file) noexcept {
  Elf64_Ehdr header{};
  if (!copyPart(file, 0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return false;
  if (!checkHeader(header) || header.e_shentsize != sizeof(Elf64_Shdr)) return false;
  bool any = false;
  Elf64_Shdr section{};
  for (std::uint64_t n = 0; n < header.e_shnum; ++n) {
    if (!copyPart(file, header.e_shoff + n * sizeof(section), section)) break;
    if (section.sh_type != SHT_DYNSYM) continue;
    Elf64_Sym symbol{};
    for (std::uint64_t at = 0; at + sizeof(symbol) <= section.sh_size; at += sizeof(symbol)) {
      if (!copyPart(file, section.sh_offset + at, symbol)) break;
      if (ELF64_ST_BIND(symbol.st_info) != STB_GNU_UNIQUE) continue;
      any = true;
      symbol.st_info = ELF64_ST_INFO(STB_WEAK, ELF64_ST_TYPE(symbol.st_info));
      std::memcpy(file.data() + section.sh_offset + at, &symbol, sizeof(symbol));
    }
  }
  return any;
}

}  // namespace teren
