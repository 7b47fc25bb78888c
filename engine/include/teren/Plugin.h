// How a module (teren-<id>.so) presents itself to the engine: one exported function that returns a
// description, in which words about the binary interface come first and are checked before anything else.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <Eigen/Core>

#include "teren/ContinuousGenerator.h"
#include "teren/Deformer.h"
#include "teren/Filter.h"
#include "teren/Generator.h"

namespace teren {

enum class PluginKind : std::uint32_t { generator = 1, filter = 2, deformer = 3 };

/// The kind's name in sentences and listings; "plugin of unknown kind" for a value that is none.
constexpr const char* kindName(PluginKind kind) noexcept {
  switch (kind) {
    case PluginKind::generator:
      return "generator";
    case PluginKind::filter:
      return "filter";
    case PluginKind::deformer:
      return "deformer";
  }
  return "plugin of unknown kind";
}

/// One fact about how a module was compiled. The engine refuses a module when one of its words differs from
/// the engine's own, and names the word.
struct AbiWord {
  const char* name;
  std::uint64_t value;
};

/// Raised whenever a type in engine/include/teren that crosses the boundary changes its layout or meaning.
inline constexpr std::uint64_t kPluginInterfaceVersion = 6;

#if defined(__SANITIZE_ADDRESS__)
inline constexpr std::uint64_t kSanitizerWord = 1;
#elif defined(__SANITIZE_THREAD__)
inline constexpr std::uint64_t kSanitizerWord = 2;
#else
inline constexpr std::uint64_t kSanitizerWord = 0;
#endif

// Without it the engine could not ask a generator whether it is continuous.
#if defined(__GXX_RTTI)
inline constexpr std::uint64_t kTypeInformationWord = 1;
#else
inline constexpr std::uint64_t kTypeInformationWord = 0;
#endif

/// The words of the translation unit that includes this header. The alignment of Eigen's fixed vectors goes
/// from 16 to 32 with -mavx, which changes the layout of anything that holds one. Not inline: the loader
/// would take the engine's own words for a module's where symbols are visible, and find them equal.
constexpr AbiWord kAbiWords[] = {
    {"plugin interface version", kPluginInterfaceVersion},
    {"C++ ABI version", __GXX_ABI_VERSION},
    {"pointer size", sizeof(void*)},
    {"C++11 string ABI", _GLIBCXX_USE_CXX11_ABI},
    {"Eigen version", EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION},
    {"alignment of Eigen::Vector4d", alignof(Eigen::Vector4d)},
    {"size of Values", sizeof(Values)},
    {"size of MapRequest", sizeof(MapRequest)},
    {"size of FieldRequest", sizeof(FieldRequest)},
    {"size of DeformRegion", sizeof(DeformRegion)},
    {"size of Stamp", sizeof(Stamp)},
    {"run-time type information", kTypeInformationWord},
    {"sanitizer", kSanitizerWord},
};

/// What a module returns. `magic`, `wordCount` and `words` have the same layout in every version; the rest
/// may be read only once the words agree. All of it lives as long as the module is loaded.
struct PluginDescription {
  std::uint64_t magic;
  std::uint64_t wordCount;
  const AbiWord* words;

  PluginKind kind;
  const char* id;  ///< lower-case letters, digits and '-'; the world file's name for it
  const char* version;
  const char* doc;  ///< one line
  std::span<const Parameter> (*parameters)() noexcept;
  /// One of the three, by kind; may throw, the engine catches.
  std::unique_ptr<Generator> (*makeGenerator)(const Values&);
  std::unique_ptr<Filter> (*makeFilter)(const Values&);
  std::unique_ptr<Deformer> (*makeDeformer)();
};

inline constexpr std::uint64_t kPluginMagic = 0x5445'5245'4e50'4c47ULL;  // "TERENPLG"
inline constexpr const char* kPluginEntryPoint = "terenPlugin";
using PluginEntryPoint = const PluginDescription* (*)();

template <class Class, class Base>
std::unique_ptr<Base> makePlugin(const Values& values) {
  return std::make_unique<Class>(values);
}

template <class Class>
std::unique_ptr<Deformer> makeDeformerPlugin() {
  return std::make_unique<Class>();
}

}  // namespace teren

#define TEREN_PLUGIN_ENTRY_(kind_, Class, id_, version_, doc_, makeGenerator_, makeFilter_, makeDeformer_) \
  extern "C" __attribute__((visibility("default"))) const teren::PluginDescription* terenPlugin() {        \
    static const teren::PluginDescription description = {teren::kPluginMagic,                              \
                                                         std::size(teren::kAbiWords),                      \
                                                         teren::kAbiWords,                                 \
                                                         teren::PluginKind::kind_,                         \
                                                         id_,                                              \
                                                         version_,                                         \
                                                         doc_,                                             \
                                                         &Class::parameters,                               \
                                                         makeGenerator_,                                   \
                                                         makeFilter_,                                      \
                                                         makeDeformer_};                                   \
    return &description;                                                                                   \
  }

/// Makes a module's entry point; once per module, at global scope.
#define TEREN_GENERATOR_PLUGIN(Class, id, version, doc)                                                  \
  TEREN_PLUGIN_ENTRY_(generator, Class, id, version, doc, (&teren::makePlugin<Class, teren::Generator>), \
                      nullptr, nullptr)
#define TEREN_FILTER_PLUGIN(Class, id, version, doc)                                                        \
  TEREN_PLUGIN_ENTRY_(filter, Class, id, version, doc, nullptr, (&teren::makePlugin<Class, teren::Filter>), \
                      nullptr)
#define TEREN_DEFORMER_PLUGIN(Class, id, version, doc)                     \
  TEREN_PLUGIN_ENTRY_(deformer, Class, id, version, doc, nullptr, nullptr, \
                      (&teren::makeDeformerPlugin<Class>))
