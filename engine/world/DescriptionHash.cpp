#include "world/DescriptionHash.h"

#include <bit>
#include <cassert>
#include <variant>
#include <vector>

#include "teren/Hash.h"

namespace teren {

namespace {

/// Takes the parts of a description one after the other; how many there are of each comes before them.
class PartHash {
 public:
  void add(std::uint64_t word) { value_ = hashWith(value_, word); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number == 0.0 ? 0.0 : number)); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    add(hashText(text));
  }
  void add(const ParameterValue& value) {
    add(std::uint64_t{value.index()});
    if (const auto* number = std::get_if<double>(&value)) add(*number);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) add(static_cast<std::uint64_t>(*whole));
    if (const auto* truth = std::get_if<bool>(&value)) add(std::uint64_t{*truth ? 1U : 0U});
    if (const auto* text = std::get_if<std::string>(&value)) add(std::string_view(*text));
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = hashText("teren world");
};

void addPlugin(PartHash& hash, std::string_view id, const std::vector<Values::Entry>& entries,
               const PluginRegistry& registry) {
  const PluginInfo* const plugin = registry.find(id);
  assert(plugin != nullptr);
  const Result<Values> values = Values::check(plugin->parameters, entries, id);
  assert(values.ok());
  hash.add(id);
  hash.add(std::uint64_t{values->entries().size()});
  for (const auto& [name, value] : values->entries()) {
    hash.add(std::string_view(name));
    hash.add(value);
  }
}

}  // namespace

std::uint64_t descriptionHash(const WorldDescription& world, std::span<const LayerDescription> layers,
                              const PluginRegistry& registry) {
  PartHash hash;
  hash.add(world.seed);
  hash.add(world.pitch);
  hash.add(static_cast<std::uint64_t>(world.samples));
  hash.add(std::uint64_t{layers.size()});
  for (const LayerDescription& layer : layers) {
    hash.add(std::string_view(layer.name));
    addPlugin(hash, layer.generator, layer.parameters, registry);
    hash.add(layer.pitch);
    hash.add(static_cast<std::uint64_t>(layer.samples));
    hash.add(std::uint64_t{layer.blend == BlendKernel::linear ? 0U : 1U});
    hash.add(std::uint64_t{layer.preserveVariance ? 1U : 0U});
    hash.add(std::uint64_t{layer.filters.size()});
    for (const FilterDescription& filter : layer.filters) {
      addPlugin(hash, filter.filter, filter.parameters, registry);
    }
  }
  return hash.value();
}

}  // namespace teren
