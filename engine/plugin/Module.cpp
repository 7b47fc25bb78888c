#include "plugin/Module.h"

#include <algorithm>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <memory>
#include <system_error>
#include <utility>

#include "teren/PluginRegistry.h"
#include "teren/Quote.h"

#include "plugin/SharedObject.h"
#include "plugin/TableCheck.h"
#include "plugin/Thrown.h"

namespace teren {
namespace {

constexpr std::string_view kPrefix = "teren-";
constexpr std::string_view kSuffix = ".so";
constexpr std::size_t kSentenceBytes = 400;  // of the loader's or a plugin's own words
constexpr std::uint64_t kMostAbiWords = 256;

struct Unload {
  void operator()(void* handle) const noexcept { dlclose(handle); }
};
using Handle = std::unique_ptr<void, Unload>;

std::string_view wordName(const AbiWord& word) {
  return word.name == nullptr ? std::string_view() : std::string_view(word.name, strnlen(word.name, 1000));
}

const AbiWord* findWord(std::span<const AbiWord> words, std::string_view name) {
  const auto found = std::find_if(words.begin(), words.end(),
                                  [name](const AbiWord& word) { return wordName(word) == name; });
  return found == words.end() ? nullptr : &*found;
}

/// dlerror's sentence without the file's name in front, which is told beside it.
std::string loaderMessage(const std::filesystem::path& file) {
  const char* text = dlerror();
  std::string_view message = text == nullptr ? std::string_view("unknown reason") : std::string_view(text);
  const std::string front = file.string() + ": ";
  if (message.starts_with(front)) message.remove_prefix(front.size());
  return shortened(message, kSentenceBytes);
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
  }
  return Error{"its kind " + std::to_string(static_cast<std::uint32_t>(description.kind)) +
               " is neither generator (1) nor filter (2)"};
}

Result<Module> checkModule(const PluginDescription* description, const std::string& expectedId) {
  if (Result<void> fixed = checkFixedPart(description); !fixed) return fixed.error();
  if (Result<void> texts = checkTexts(*description, expectedId); !texts) return texts.error();
  if (Result<void> kind = checkKind(*description); !kind) return kind.error();
  if (description->parameters == nullptr) return Error{"its description has no parameter table"};
  const std::span<const Parameter> table = description->parameters();
  if (Result<void> checked = checkTable(table); !checked) return checked.error();
  return Module{description, table};
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

Result<Module> openModule(const std::filesystem::path& file) {
  const std::string expectedId = pluginIdFromFile(file);
  if (!isPluginId(expectedId)) {
    return Error{"a module's file name must be teren-<id>.so, the id in lower-case letters, digits and '-'"};
  }
  if (Result<void> object = checkSharedObject(file); !object) return object.error();
  // A name with a slash, or the loader would search its own folders.
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(file, error);
  if (error) return Error{"the current folder is gone"};
  Handle handle(dlopen(whole.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (handle == nullptr) return Error{"the loader refuses it: " + loaderMessage(whole)};
  void* const symbol = dlsym(handle.get(), kPluginEntryPoint);
  if (symbol == nullptr) {
    return Error{std::string("it does not export the function ") + kPluginEntryPoint};
  }
  const Result<const PluginDescription*> description = callEntryPoint(symbol);
  if (!description) return description.error();
  Result<Module> module = checkModule(description.value(), expectedId);
  if (module) static_cast<void>(handle.release());
  return module;
}

}  // namespace teren
