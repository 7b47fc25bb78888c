// A plot of the report, drawn by gnuplot.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "teren/Result.h"

namespace teren {

struct Curve {
  std::string title;
  std::vector<std::pair<double, double>> points;  ///< finite
  bool isDashed = false;                          ///< in the colour of the curve before
};

struct Plot {
  std::string name;  ///< of the file, without its ending: lower-case letters and '-'
  std::string title, xLabel, yLabel;
  bool xLogarithmic = false, yLogarithmic = false;  ///< then points that are not positive are left out
  std::vector<Curve> curves = {};
};

/// What gnuplot is asked to draw; curves without a point are left out. Texts may hold anything.
std::string scriptOf(const Plot& plot);

/// The picture as a whole SVG document. Errors: gnuplot's, a picture that is cut off, and a plot without a
/// point.
Result<std::string> drawn(const Plot& plot);

/// A document's <svg> element, to be put into a page: without what stands before it, and with ids that begin
/// with `name`, so that several pictures can stand in one page. Empty where there is no such element.
std::string inlineSvg(const std::string& document, const std::string& name);

}  // namespace teren
