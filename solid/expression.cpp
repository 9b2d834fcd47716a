#include "solid/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"

namespace tether {

/// The parser and the places from which it reads the values.
struct Expression::Parser {
  mu::Parser parser;
  std::vector<double> values;
};

namespace {

/// "k = 3" would set what is given.
bool assigns(const std::string& text) {
  for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 1)) {
    const char before = i > 0 ? text[i - 1] : ' ', after = i + 1 < text.size() ? text[i + 1] : ' ';
    if (std::string("=<>!").find(before) == std::string::npos && after != '=') return true;
  }
  return false;
}

}  // namespace

Expression::Expression(std::string text, const std::vector<std::string>& names)
    : text_(std::move(text)), parser_(std::make_unique<Parser>()) {
  parser_->values.assign(names.size(), 1.0);
  if (assigns(text_)) throw input_error("\"{}\": a formula cannot set a value: two of them are compared by ==", text_);
  double value = 0;
  try {
    parser_->parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t i = 0; i < names.size(); ++i) parser_->parser.DefineVar(names[i], &parser_->values[i]);
    parser_->parser.SetExpr(text_);
    value = parser_->parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw input_error("\"{}\": {}", text_, error.GetMsg());
  }
  if (parser_->parser.GetUsedVar().empty() && !std::isfinite(value))
    throw input_error("\"{}\": is not a finite number", text_);
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

bool Expression::uses(const std::string& name) const {
  return parser_->parser.GetUsedVar().contains(name);
}

double Expression::operator()(const std::vector<double>& values) const {
  TETHER_ASSERT(values.size() == parser_->values.size(), "{} of {} values", values.size(), parser_->values.size());
  std::copy(values.begin(), values.end(), parser_->values.begin());
  const double result = parser_->parser.Eval();
  if (!std::isfinite(result))
    throw run_error("the expression \"{}\" has no finite value at a point of the wall", text_);
  return result;
}

}  // namespace tether
