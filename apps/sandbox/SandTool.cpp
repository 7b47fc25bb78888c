#include "apps/sandbox/SandTool.h"

#include <sstream>
#include <string_view>
#include <utility>

#include "teren/Quote.h"

#include "apps/files/InputFile.h"

namespace teren {
namespace {

constexpr std::size_t kMostOutlineBytes = 65536;
constexpr std::string_view kTools[] = {"round", "square", "rake", "wedge", "ball", "polygon"};
constexpr const char* kSpace = " \t\r\n\v\f";

Error noPoint(std::string_view word) {
  return Error{"a tool's outline has " + inQuotes(word) + " where a point like 0.5,-0.5 was expected"};
}

}  // namespace

std::span<const Parameter> SandTool::parameters() noexcept {
  static constexpr Parameter table[] = {
      Parameter::choice("tool", "round", kTools, "what is pressed into the sand"),
      Parameter::real("size", 0.08, 1e-4, 1000.0, "m", "of the tool, from side to side"),
      Parameter::real("depth", 0.03, 1e-5, 1000.0, "m", "how far the tool reaches into the sand"),
      Parameter::integer("teeth", 5, 1, 32, "", "of a rake"),
      Parameter::integer("corners", 16, 3, 256, "", "of a round tool"),
      Parameter::text("outline", "0.5,0 -0.5,0.4 -0.2,0 -0.5,-0.4", kMostOutlineBytes,
                      "of a polygon: points X,Y in sizes from its middle; x is the way it is pushed"),
  };
  return table;
}

Result<ToolShape> SandTool::shape(const Values& values) {
  const std::string& tool = values.choice("tool");
  const double size = values.real("size"), depth = values.real("depth");
  if (tool == "square") return ToolShape::square(size, depth);
  if (tool == "rake") return ToolShape::rake(size, depth, static_cast<int>(values.integer("teeth")));
  if (tool == "wedge") return ToolShape::wedge(size, depth);
  if (tool == "ball") return ToolShape::ball(0.5 * size, depth);
  if (tool == "polygon") {
    Result<std::vector<ToolPoint>> outline = parseOutline(values.text("outline"));
    if (!outline) return outline.error();
    for (ToolPoint& p : *outline) p = {size * p.x, size * p.y};
    return ToolShape::polygon(*outline, depth);
  }
  return ToolShape::disc(0.5 * size, depth, static_cast<int>(values.integer("corners")));
}

Result<std::vector<ToolPoint>> parseOutline(std::string_view text) {
  std::vector<ToolPoint> points;
  for (std::size_t begin = text.find_first_not_of(kSpace); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos) return noPoint(word);
    const Result<double> x = parseNumber(word.substr(0, comma)), y = parseNumber(word.substr(comma + 1));
    if (!x || !y) return noPoint(word);
    if (points.size() == ToolShape::kMostPoints) {
      return Error{"a tool's outline has more than " + std::to_string(ToolShape::kMostPoints) + " points"};
    }
    points.push_back({*x, *y});
    begin = text.find_first_not_of(kSpace, end);
  }
  return points;
}

Result<std::string> readOutline(const std::string& file) {
  const Result<std::string> text = readFile(file, kMostOutlineBytes);
  if (!text) return text.error();
  std::string outline;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; words >> word;) outline += outline.empty() ? word : " " + word;
  }
  if (const auto points = parseOutline(outline); !points) {
    return Error{inQuotes(file) + ": " + points.error().message};
  }
  return outline;
}

}  // namespace teren
