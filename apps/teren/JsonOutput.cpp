#include "apps/teren/JsonOutput.h"

#include <iostream>

namespace teren {

void printJson(const OrderedJson& value) {
  std::cout << value.dump(2, ' ', false, OrderedJson::error_handler_t::replace) << '\n';
}

const char* kindText(PluginKind kind) {
  return kind == PluginKind::generator ? "generator" : "filter";
}

}  // namespace teren
