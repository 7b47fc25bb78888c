// How checks call a plugin: whatever it throws becomes a counter-example that says where.
#pragma once

#include <exception>
#include <string>

#include "teren/Quote.h"

#include "apps/check/Counterexample.h"

namespace teren::check {

inline constexpr std::size_t kSentenceBytes = 200;  // of a plugin's own words

/// What `call` returns; `where` makes the beginning of the counter-example's text.
template <class Where, class Call>
auto called(const Where& where, const Call& call) {
  try {
    return call();
  } catch (const Counterexample&) {
    throw;
  } catch (const std::exception& exception) {
    const char* const text = exception.what();  // a foreign class, which may have none
    throw Counterexample{
        where() + ": it threw " +
        inQuotes(text == nullptr ? "an exception without a text" : shortened(text, kSentenceBytes))};
  } catch (...) {
    throw Counterexample{where() + ": it threw something that is no std::exception"};
  }
}

}  // namespace teren::check
