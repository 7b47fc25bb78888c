#include "apps/report/Plot.h"

#include <array>
#include <cstdio>
#include <memory>
#include <string_view>

#include "teren/Parameter.h"

#include "apps/report/Gnuplot.h"

namespace teren {
namespace {

/// In gnuplot's single quotes; without the marks of its text language and without what ends the line.
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ') continue;
    if (c == '\'') all += '\'';
    all += c;
  }
  return all + "'";
}

std::string pointsOf(const Plot& plot, const Curve& curve) {
  std::string points;
  for (const auto& [x, y] : curve.points) {
    if ((plot.xLogarithmic && !(x > 0.0)) || (plot.yLogarithmic && !(y > 0.0))) continue;
    points += numberText(x) + " " + numberText(y) + "\n";
  }
  return points;
}

/// Of the curves of one colour, from 1 on.
std::string styleOf(std::size_t colour) {
  const std::size_t index = colour == 0 ? 0 : colour - 1;
  // gnuplot's fifth colour is yellow, which nobody sees on white
  const std::size_t type = index % 7 < 4 ? index % 7 + 1 : index % 7 + 2;
  const std::size_t mark = std::array<std::size_t, 4>{7, 5, 9, 13}[index / 7 % 4];
  return " pointtype " + std::to_string(mark) + " pointsize 0.6 linewidth 2 linetype " + std::to_string(type);
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string scriptOf(const Plot& plot) {
  std::string script =
      "set terminal svg noenhanced size 860,520 font 'sans,13' background 'white'\nset title " +
      quoted(plot.title) + "\nset xlabel " + quoted(plot.xLabel) + "\nset ylabel " + quoted(plot.yLabel) +
      "\nset key below\nset grid\n";
  if (plot.xLogarithmic) script += "set logscale x\nset format x '%g'\n";
  if (plot.yLogarithmic) script += "set logscale y\nset format y '%g'\n";
  std::string data, lines;
  std::size_t drawn = 0, colour = 0;
  for (const Curve& curve : plot.curves) {
    const std::string points = pointsOf(plot, curve);
    if (points.empty()) continue;
    const std::string name = "$curve" + std::to_string(drawn++);
    if (!curve.isDashed) ++colour;
    data += name + " << EOD\n" + points + "EOD\n";
    lines += (lines.empty() ? "plot " : ", ") + name + " with linespoints" + styleOf(colour) +
             (curve.isDashed ? " dashtype 2" : "") + " title " + quoted(curve.title);
  }
  return drawn == 0 ? std::string() : script + data + lines + "\n";
}

Result<std::string> drawn(const Plot& plot) {
  const std::string script = scriptOf(plot);
  if (script.empty()) return Error{"the plot " + plot.name + " has no points"};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> picture(std::tmpfile(), &std::fclose);
  if (picture == nullptr) return Error{"no temporary file can be made"};
  if (const Result<void> done = drawWithGnuplot(script, picture.get()); !done) return done.error();
  std::rewind(picture.get());
  std::string document;
  std::array<char, std::size_t{1} << 14> piece;
  for (std::size_t read = 1; read > 0;) {
    read = std::fread(piece.data(), 1, piece.size(), picture.get());
    document.append(piece.data(), read);
  }
  if (std::ferror(picture.get()) != 0) return Error{"the temporary file cannot be read"};
  // gnuplot may end well where a full disk has kept a part
  const std::size_t last = document.find_last_not_of(" \r\n");
  if (last == std::string::npos || !std::string_view(document).substr(0, last + 1).ends_with("</svg>")) {
    return Error{"gnuplot has not drawn all of the plot " + plot.name + ", perhaps for want of room"};
  }
  return document;
}

std::string inlineSvg(const std::string& document, const std::string& name) {
  const std::size_t begin = document.find("<svg"), end = document.rfind("</svg>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
  std::string svg = document.substr(begin, end + 6 - begin);
  for (const std::string mark : {" id='", " id=\"", "xlink:href='#", "url(#"}) {
    replaceAll(svg, mark, mark + name + "-");
  }
  return svg;
}

}  // namespace teren
