// The JSON form of a world description. Every refusal names the source, the key's place and the value.
#include <algorithm>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "teren/Quote.h"
#include "teren/World.h"

namespace teren {

namespace {

using nlohmann::json;

constexpr int kMaxDepth = 32;
constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr std::size_t kShownBytes = 40;     ///< of a key or a value in a message
constexpr std::size_t kShownSource = 1024;  ///< of a file's name

/// A JSON object being read: knows its place for messages, and which of its keys were asked for.
class ObjectReader {
 public:
  ObjectReader(const json& object, std::string place) : object_(object), place_(std::move(place)) {}

  Error complaint(std::string_view key, const std::string& what) const {
    return Error{place_ + (key.empty() ? "" : (place_.empty() ? "" : ".") + std::string(key)) + " " + what};
  }
  Error expected(std::string_view key, const std::string& what) const {
    const std::string value =
        object_.at(std::string(key)).dump(-1, ' ', false, json::error_handler_t::replace);
    return complaint(key, "is " + shortened(value, kShownBytes) + ", expected " + what);
  }
  Result<void> onlyKeys(std::initializer_list<std::string_view> known) const {
    if (!object_.is_object()) return complaint("", "is not an object");
    for (const auto& item : object_.items()) {
      if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
      std::string list;
      for (const std::string_view key : known) list += (list.empty() ? "" : ", ") + std::string(key);
      return complaint(shortened(item.key(), kShownBytes), "is not a known key, expected one of " + list);
    }
    return {};
  }
  const json* find(const char* key) const {
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }
  std::string place(const char* key) const { return (place_.empty() ? "" : place_ + ".") + key; }

  Result<void> read(const char* key, double& value) const {
    const json* found = find(key);
    if (!found) return {};
    if (!found->is_number()) return expected(key, "a number");
    value = found->get<double>();
    return {};
  }
  Result<void> read(const char* key, int& value) const {
    const json* found = find(key);
    if (!found) return {};
    if (!found->is_number_integer() || found->get<double>() < 0.0 || found->get<double>() > 1e9) {
      return expected(key, "a whole number from 0 to 1e9");
    }
    value = found->get<int>();
    return {};
  }
  Result<void> read(const char* key, std::uint64_t& value) const {
    const json* found = find(key);
    if (!found) return {};
    if (!found->is_number_unsigned()) return expected(key, "a whole number from 0 to 2^64 - 1");
    value = found->get<std::uint64_t>();
    return {};
  }
  Result<void> read(const char* key, bool& value) const {
    const json* found = find(key);
    if (!found) return {};
    if (!found->is_boolean()) return expected(key, "true or false");
    value = found->get<bool>();
    return {};
  }
  Result<void> read(const char* key, std::string& value) const {
    const json* found = find(key);
    if (!found) return {};
    if (!found->is_string()) return expected(key, "a text");
    value = found->get<std::string>();
    if (value.empty() || value.size() > 200) return expected(key, "a text of 1 to 200 characters");
    return {};
  }
  Result<void> read(const char* key, BlendKernel& value) const {
    const json* found = find(key);
    if (!found) return {};
    if (*found == "linear") {
      value = BlendKernel::linear;
    } else if (*found == "smooth") {
      value = BlendKernel::smooth;
    } else {
      return expected(key, "\"linear\" or \"smooth\"");
    }
    return {};
  }
  Result<void> read(const char* key, std::vector<Values::Entry>& entries) const {
    const json* found = find(key);
    if (!found) return {};
    if (!found->is_object()) return expected(key, "an object");
    for (const auto& [name, value] : found->items()) {
      if (value.is_boolean()) {
        entries.emplace_back(name, value.get<bool>());
      } else if (value.is_string()) {
        entries.emplace_back(name, value.get<std::string>());
      } else if (value.is_number_integer() &&
                 !(value.is_number_unsigned() &&
                   value.get<std::uint64_t>() > std::uint64_t{std::numeric_limits<std::int64_t>::max()})) {
        entries.emplace_back(name, value.get<std::int64_t>());
      } else if (value.is_number()) {
        entries.emplace_back(name, value.get<double>());
      } else {
        return complaint(std::string(key) + "." + shortened(name, kShownBytes),
                         "is neither a number, a text nor true or false");
      }
    }
    return {};
  }

 private:
  const json& object_;
  std::string place_;
};

/// Reads keys until one is refused.
template <class... Targets>
Result<void> readAll(const ObjectReader& reader, std::pair<const char*, Targets&>... targets) {
  Result<void> result;
  (void)((result = reader.read(targets.first, targets.second), result.ok()) && ...);
  return result;
}

template <class Target>
std::pair<const char*, Target&> key(const char* name, Target& target) {
  return {name, target};
}

Result<FilterDescription> readFilter(const json& object, const std::string& place) {
  const ObjectReader reader(object, place);
  if (const auto known = reader.onlyKeys({"filter", "parameters"}); !known) return known.error();
  FilterDescription filter;
  if (const auto read = readAll(reader, key("filter", filter.filter), key("parameters", filter.parameters));
      !read) {
    return read.error();
  }
  if (filter.filter.empty()) return reader.complaint("", "has no \"filter\", expected a plugin id");
  return filter;
}

Result<LayerDescription> readLayer(const json& object, const std::string& place,
                                   const LayerDescription& defaults) {
  const ObjectReader reader(object, place);
  if (const auto known = reader.onlyKeys(
          {"name", "generator", "parameters", "pitch", "samples", "blend", "preserveVariance", "filters"});
      !known) {
    return known.error();
  }
  LayerDescription layer = defaults;
  if (const auto read = readAll(reader, key("name", layer.name), key("generator", layer.generator),
                                key("parameters", layer.parameters), key("pitch", layer.pitch),
                                key("samples", layer.samples), key("blend", layer.blend),
                                key("preserveVariance", layer.preserveVariance));
      !read) {
    return read.error();
  }
  if (layer.generator.empty()) return reader.complaint("", "has no \"generator\", expected a plugin id");
  const json* filters = reader.find("filters");
  if (!filters) return layer;
  if (!filters->is_array()) return reader.expected("filters", "a list");
  for (const json& item : *filters) {
    Result<FilterDescription> filter =
        readFilter(item, reader.place("filters") + "[" + std::to_string(layer.filters.size()) + "]");
    if (!filter) return filter.error();
    layer.filters.push_back(std::move(*filter));
  }
  return layer;
}

Result<WorldDescription> readWorld(const json& object) {
  const ObjectReader reader(object, "");
  if (!object.is_object()) return Error{"the outermost value is not an object"};
  if (const auto known = reader.onlyKeys({"seed", "pitch", "samples", "blend", "preserveVariance", "layers"});
      !known) {
    return known.error();
  }
  WorldDescription world;
  LayerDescription defaults;
  if (const auto read =
          readAll(reader, key("seed", world.seed), key("pitch", world.pitch), key("samples", world.samples),
                  key("blend", defaults.blend), key("preserveVariance", defaults.preserveVariance));
      !read) {
    return read.error();
  }
  defaults.pitch = world.pitch;
  defaults.samples = world.samples;
  const json* layers = reader.find("layers");
  if (!layers) return Error{"the key layers is missing, expected a list of layers"};
  if (!layers->is_array() || layers->empty())
    return reader.expected("layers", "a list of at least one layer");
  for (const json& item : *layers) {
    Result<LayerDescription> layer =
        readLayer(item, "layers[" + std::to_string(world.layers.size()) + "]", defaults);
    if (!layer) return layer.error();
    world.layers.push_back(std::move(*layer));
  }
  return world;
}

/// Watches the library parse, for what it would let pass: deep nesting and keys given twice.
class ParseWatch {
 public:
  /// Called by the parser; false drops the value, so that a refused text costs no more memory.
  bool operator()(int depth, json::parse_event_t event, const json& parsed) {
    if (!problem_.empty()) return false;
    if (depth > kMaxDepth) problem_ = "is nested more than " + std::to_string(kMaxDepth) + " levels deep";
    if (event == json::parse_event_t::object_start) keys_.emplace_back();
    if (event == json::parse_event_t::object_end && !keys_.empty()) keys_.pop_back();
    if (event == json::parse_event_t::key && !keys_.empty()) {
      lastKey_ = parsed.get<std::string>();
      if (!keys_.back().insert(lastKey_).second) {
        problem_ = "has the key \"" + shortened(lastKey_, kShownBytes) + "\" twice in one object";
      }
    }
    return problem_.empty();
  }

  const std::string& problem() const noexcept { return problem_; }
  /// Why the parser gave up.
  std::string describe(const json::exception& error) const {
    if (!problem_.empty()) return problem_;
    if (const auto* syntax = dynamic_cast<const json::parse_error*>(&error)) {
      return "is not JSON: problem at byte " + std::to_string(syntax->byte);
    }
    // What is left is a number beyond the range of double; the library shows it between apostrophes.
    const std::string_view text = error.what();
    const std::string_view number = text.substr(std::min(text.find('\''), text.size()));
    return "has a number that is too large, " + shortened(number, kShownBytes) + ", after the key \"" +
           shortened(lastKey_, kShownBytes) + "\"";
  }

 private:
  std::vector<std::set<std::string>> keys_;  // of the objects that are open
  std::string lastKey_, problem_;
};

Result<json> parse(std::string_view text) {
  ParseWatch watch;
  try {
    json parsed = json::parse(text, std::ref(watch));
    if (!watch.problem().empty()) return Error{watch.problem()};
    return parsed;
  } catch (const json::exception& error) {
    return Error{watch.describe(error)};
  }
}

}  // namespace

Result<WorldDescription> WorldDescription::fromJson(std::string_view text, std::string_view source) {
  const std::string name = shortened(source, kShownSource);
  if (text.size() > kMaxBytes) return Error{name + " is larger than 16 MiB, which no world description is"};
  const Result<json> parsed = parse(text);
  if (!parsed) return Error{name + " " + parsed.error().message};
  Result<WorldDescription> world = readWorld(*parsed);
  if (!world) return Error{name + ": " + world.error().message};
  return world;
}

Result<WorldDescription> WorldDescription::fromFile(const std::filesystem::path& file) {
  const std::string name = file.empty() ? "\"\"" : shortened(file.string(), kShownSource);
  std::error_code problem;
  // A zero byte ends a name for the system, which would open another file.
  const bool cutShort = file.native().find('\0') != std::string::npos;
  if (cutShort || !std::filesystem::is_regular_file(file, problem)) {
    return Error{name + " is not a file that can be read, expected a world description in JSON"};
  }
  // Read with a limit, not by the size it claims: files of the kernel claim none and may have no end.
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  std::vector<char> piece(std::size_t{1} << 16);
  while (stream && text.size() <= kMaxBytes) {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.is_open() || stream.bad()) return Error{name + " could not be read"};
  return fromJson(text, file.string());
}

WorldDescription WorldDescription::standard() {
  const auto layer = [](const char* name, const char* generator, double pitch,
                        std::vector<Values::Entry> parameters) {
    LayerDescription description;
    description.name = name;
    description.generator = generator;
    description.parameters = std::move(parameters);
    description.pitch = pitch;
    return description;
  };
  WorldDescription world;
  world.seed = 42;
  world.layers = {layer("ranges", "spectral", 8192.0, {{"hurst", 1.0}, {"deviation", 500.0}}),
                  layer("hills", "spectral", 1024.0, {{"hurst", 0.8}, {"deviation", 60.0}}),
                  layer("detail", "fault", 64.0, {{"faults", std::int64_t{150}}, {"deviation", 2.5}})};
  return world;
}

}  // namespace teren
