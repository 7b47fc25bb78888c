#include "plugin/Module.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <fstream>
#include <system_error>
#include <utility>

#include "teren/Hash.h"
#include "teren/Quote.h"

#include "plugin/LoadedLibrary.h"
#include "plugin/SharedObject.h"
#include "plugin/TableCheck.h"
#include "plugin/Thrown.h"

namespace teren {
namespace {

constexpr std::string_view kPrefix = "teren-";
constexpr std::string_view kSuffix = ".so";
constexpr std::size_t kSentenceBytes = 400;  // of a plugin's own words
constexpr std::uint64_t kMostAbiWords = 256;
constexpr std::uintmax_t kMostModuleBytes = std::uintmax_t{1} << 30;

std::string_view wordName(const AbiWord& word) {
  return word.name == nullptr ? std::string_view() : std::string_view(word.name, strnlen(word.name, 1000));
}

const AbiWord* findWord(std::span<const AbiWord> words, std::string_view name) {
  const auto found = std::find_if(words.begin(), words.end(),
                                  [name](const AbiWord& word) { return wordName(word) == name; });
  return found == words.end() ? nullptr : &*found;
}

/// All of a module's file.
Result<std::string> bytesOf(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return Error{"it cannot be read"};
  if (size > kMostModuleBytes) {
    return Error{"it has " + std::to_string(size) + " bytes, expected at most 2^30"};
  }
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) return Error{"it cannot be read"};
  return bytes;
}

Result<const PluginDescription*> callEntryPoint(void* symbol) {
  try {
    return reinterpret_cast<PluginEntryPoint>(symbol)();
  } catch (const std::exception& exception) {
    return Error{std::string("its function ") + kPluginEntryPoint +
                 " threw: " + shortened(textOf(exception), kSentenceBytes)};
  } catch (...) {
    return Error{std::string("its function ") + kPluginEntryPoint + " threw something"};
  }
}

/// The part of the description whose layout never changes.
Result<void> checkFixedPart(const PluginDescription* description) {
  if (description == nullptr) {
    return Error{std::string("its function ") + kPluginEntryPoint + " returned no description"};
  }
  if (description->magic != kPluginMagic) {
    return Error{"its description does not begin with Teren's magic number"};
  }
  if (description->words == nullptr || description->wordCount > kMostAbiWords) {
    return Error{"its description holds no readable list of ABI words"};
  }
  return compareAbiWords({description->words, static_cast<std::size_t>(description->wordCount)}, kAbiWords);
}

Result<void> checkTexts(const PluginDescription& description, const std::string& expectedId) {
  if (description.id == nullptr) return Error{"its description has no id"};
  if (description.version == nullptr) return Error{"its description has no version"};
  if (description.doc == nullptr) return Error{"its description has no line of documentation"};
  const std::string_view id(description.id, strnlen(description.id, 1000));
  if (!isPluginId(id)) {
    return Error{"its id " + inQuotes(id) + " is not made of lower-case letters, digits and '-', 1 to " +
                 std::to_string(kLongestPluginId)};
  }
  if (id != expectedId) {
    return Error{"its id is " + inQuotes(id) + " but its file name says " + inQuotes(expectedId)};
  }
  return {};
}

Result<void> checkKind(const PluginDescription& description) {
  switch (description.kind) {
    case PluginKind::generator:
      if (description.makeGenerator == nullptr) return Error{"it is a generator but has no makeGenerator"};
      return {};
    case PluginKind::filter:
      if (description.makeFilter == nullptr) return Error{"it is a filter but has no makeFilter"};
      return {};
    case PluginKind::deformer:
      if (description.makeDeformer == nullptr) return Error{"it is a deformer but has no makeDeformer"};
      return {};
  }
  return Error{"its kind " + std::to_string(static_cast<std::uint32_t>(description.kind)) +
               " is none of generator (1), filter (2) and deformer (3)"};
}

Result<void> checkDescription(const PluginDescription* description, const std::string& expectedId) {
  if (Result<void> fixed = checkFixedPart(description); !fixed) return fixed;
  if (Result<void> texts = checkTexts(*description, expectedId); !texts) return texts;
  if (Result<void> kind = checkKind(*description); !kind) return kind;
  if (description->parameters == nullptr) return Error{"its description has no parameter table"};
  return checkTable(description->parameters());
}

/// Asks a loaded library what it is, and keeps it if that can be believed.
Result<std::shared_ptr<const Module>> accept(LoadedLibrary library, const std::string& expectedId,
                                             std::uint64_t contents) {
  void* const symbol = library.symbol(kPluginEntryPoint);
  if (symbol == nullptr) {
    return Error{std::string("it does not export the function ") + kPluginEntryPoint};
  }
  const Result<const PluginDescription*> description = callEntryPoint(symbol);
  if (!description) return description.error();
  if (Result<void> checked = checkDescription(*description, expectedId); !checked) return checked.error();
  library.keep();
  return std::make_shared<const Module>(Module{*description, (*description)->parameters(), contents});
}

}  // namespace

std::string pluginIdFromFile(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (name.size() <= kPrefix.size() + kSuffix.size()) return {};
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return {};
  return name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size());
}

Result<void> compareAbiWords(std::span<const AbiWord> module, std::span<const AbiWord> engine) {
  std::string differences;
  const auto add = [&differences](std::string_view name, const std::string& there, const std::string& here) {
    differences += (differences.empty() ? "" : ", ") + inQuotes(name) + " is " + there +
                   " in the module and " + here + " in the engine";
  };
  for (const AbiWord& word : engine) {
    const AbiWord* there = findWord(module, wordName(word));
    if (there == nullptr) {
      add(wordName(word), "missing", std::to_string(word.value));
    } else if (there->value != word.value) {
      add(wordName(word), std::to_string(there->value), std::to_string(word.value));
    }
  }
  for (const AbiWord& word : module) {
    if (findWord(engine, wordName(word)) == nullptr) {
      add(wordName(word), std::to_string(word.value), "unknown");
    }
  }
  if (differences.empty()) return {};
  return Error{"it was built for another binary interface: " + differences};
}

Result<std::shared_ptr<const Module>> openModule(const std::filesystem::path& file, ModuleLoading loading,
                                                 const std::shared_ptr<const Module>& before) {
  const std::string expectedId = pluginIdFromFile(file);
  if (!isPluginId(expectedId)) {
    return Error{"a module's file name must be teren-<id>.so, the id in lower-case letters, digits and '-'"};
  }
  if (Result<void> object = checkSharedObject(file); !object) return object.error();
  Result<std::string> bytes = bytesOf(file);
  if (!bytes) return bytes.error();
  const std::uint64_t contents = hashText(*bytes);
  if (before && before->contents == contents) return before;
  const bool mixing = makeUniqueSymbolsWeak(*bytes);
  Result<LoadedLibrary> library = loading == ModuleLoading::mapped && !mixing
                                      ? LoadedLibrary::map(file)
                                      : LoadedLibrary::copy(*bytes, file.filename().string());
  if (!library) return library.error();
  return accept(std::move(*library), expectedId, contents);
}

}  // namespace teren
