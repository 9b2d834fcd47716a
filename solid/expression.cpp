#include "solid/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <random>

#include "common/base/error.hpp"
#include "common/base/shortened.hpp"

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

/// Of a list muParser would take the last: "0,5*k" as 5*k. Those of a function's arguments separate.
bool lists(const std::string& text) {
  std::vector<bool> of_function;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') {
      const std::size_t before = text.find_last_not_of(" \t", i == 0 ? std::string::npos : i - 1);
      of_function.push_back(i > 0 && before != std::string::npos &&
                            (std::isalnum(static_cast<unsigned char>(text[before])) || text[before] == '_'));
    } else if (text[i] == ')' && !of_function.empty()) {
      of_function.pop_back();
    } else if (text[i] == ',' && (of_function.empty() || !of_function.back())) {
      return true;
    }
  }
  return false;
}

/// Of pressures, lengths and velocities alike; a formula may have a value for some of them only.
constexpr std::array tried{0.0, 1.0, -1.0, 0.01, -0.01, 30.0, -30.0, 1e3, -1e3, 1e5, -1e5};
constexpr int trials = 1000;

constexpr std::size_t longest_told = 200;  ///< bytes of muParser's words, which quote the formula's

/// For any values, tried together in an order that is the same each time.
bool is_ever_finite(const mu::Parser& parser, std::vector<double>& values) {
  std::minstd_rand order;
  for (int k = 0; k < trials; ++k) {
    for (double& value : values) value = tried[order() % tried.size()];
    if (std::isfinite(parser.Eval())) return true;
  }
  return false;
}

}  // namespace

Expression::Expression(std::string text, const std::vector<std::string>& names)
    : text_(std::move(text)), parser_(std::make_unique<Parser>()) {
  parser_->values.assign(names.size(), 1.0);
  const std::string shown = shortened(text_);
  if (assigns(text_)) throw input_error("\"{}\": a formula cannot set a value: two of them are compared by ==", shown);
  if (lists(text_)) throw input_error("\"{}\": numbers have points (0.5), and a formula is one, not a list", shown);
  bool is_finite = false;
  try {
    parser_->parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t i = 0; i < names.size(); ++i) parser_->parser.DefineVar(names[i], &parser_->values[i]);
    parser_->parser.SetExpr(text_);
    is_finite = is_ever_finite(parser_->parser, parser_->values);
  } catch (const mu::Parser::exception_type& error) {
    throw input_error("\"{}\": {}", shown, shortened(error.GetMsg(), longest_told));
  }
  if (!is_finite)
    throw input_error("\"{}\": is not a finite number{}", shown,
                      parser_->parser.GetUsedVar().empty() ? "" : ", whatever its variables are");
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
    throw run_error("the expression \"{}\" has no finite value at a point of the wall", shortened(text_));
  return result;
}

}  // namespace tether
