#include "apps/report/FrameTable.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "teren/Quote.h"

#include "apps/files/InputFile.h"

namespace teren {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;

struct Figure {
  const char *group, *name;  // group may be empty
  Column column;
  bool mayLack = false;  // all of its group may be missing
};

std::vector<Figure> figures() {
  return {{"detail",
           "pixel_error",
           {"pixel error", "px", "DetailSettings::pixelError; nothing of a view of one level"},
           true},
          {"detail", "distance", {"view distance", "m", "the same"}, true},
          {"detail", "lines", {"lines", "px", "of the picture"}, true},
          {"", "frames", {"frames", "", "drawn"}},
          {"frame_ms", "p50", {"frame median", "ms", "wall time of a frame"}},
          {"frame_ms", "p99", {"frame p99", "ms", "the same"}},
          {"frame_ms", "max", {"frame max", "ms", "the same"}},
          {"engine_us", "p50", {"update median", "us", "wall time of Engine::update in a frame"}},
          {"engine_us", "p99", {"update p99", "us", "the same"}},
          {"", "triangles", {"triangles", "", "at the end"}},
          {"", "nodes", {"nodes", "", "at the end"}},
          {"pixel_error", "p99", {"promised p99", "px", "at the end"}},
          {"pixel_error", "max", {"promised max", "px", "at the end"}}};
}

Result<Cell> numberIn(const nlohmann::json& json, const Figure& figure, const std::string& file) {
  const std::string group = figure.group;
  if (figure.mayLack && !json.contains(group)) return Cell();
  const nlohmann::json* object = &json;
  if (!group.empty()) object = json.contains(group) ? &json.at(group) : nullptr;
  const std::string name = (group.empty() ? "" : group + ".") + figure.name;
  if (object == nullptr || !object->is_object() || !object->contains(figure.name) ||
      !object->at(figure.name).is_number()) {
    return Error{inQuotes(file) + " has no number " + name + ", expected what teren-fly --stats writes"};
  }
  const double number = object->at(figure.name).get<double>();
  if (!std::isfinite(number)) return Error{inQuotes(file) + ": " + name + " is not finite"};
  return Cell(number);
}

}  // namespace

Result<Table> readFrames(std::span<const std::string> files) {
  std::vector<Column> columns{{"file", "", "that was read"}};
  for (const Figure& figure : figures()) columns.push_back(figure.column);
  Table table("frames", "Frames of programs with a window", "As read from the files given with --frames.",
              std::move(columns));
  for (const std::string& file : files) {
    const Result<std::string> text = readFile(file, kMostBytes);
    if (!text) return text.error();
    const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
    if (!json.is_object()) return Error{inQuotes(file) + " is no JSON object"};
    std::vector<Cell> row{std::filesystem::path(file).filename().string()};
    for (const Figure& figure : figures()) {
      Result<Cell> number = numberIn(json, figure, file);
      if (!number) return number.error();
      row.push_back(*std::move(number));
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace teren
