// The report's one page: tables, pictures and what they justify, in a file that needs no other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/report/Defaults.h"
#include "apps/report/Table.h"

namespace teren {

/// A table, or a paragraph in its place where there is none, with the pictures below it.
struct PageSection {
  std::string title;
  std::string doc;                    ///< a paragraph
  const Table* table = nullptr;       ///< must outlive the page; nullptr: none
  std::vector<std::string> pictures;  ///< <svg> elements
};

struct Page {
  std::string title;
  std::vector<std::string> facts;  ///< of the run: what machine, how much was measured; a sentence each
  std::vector<PageSection> sections;
  std::vector<Justification> defaults;
};

/// HTML 5, in UTF-8. Nothing in it is fetched from anywhere.
std::string htmlOf(const Page& page);

/// "model of the processor, N processors, built with asserts" of the machine it runs on.
std::string machineText();

}  // namespace teren
