#pragma once

#include <memory>
#include <string>
#include <vector>

namespace tether {

/// A formula of named numbers, written as text: "-k*(uz - 0.2)^3". Operators + - * / ^, comparisons, ?:, && ||, and sin
/// cos tan exp ln log10 sqrt abs min max tanh ...; pi is known.
class Expression {
 public:
  /// Throws InputError for text that is no formula of these names.
  Expression(std::string text, const std::vector<std::string>& names);
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  const std::string& text() const { return text_; }
  /// Whether the formula contains this name.
  bool uses(const std::string& name) const;
  /// Values in the order of the names. Throws RunError where the result is not finite.
  double operator()(const std::vector<double>& values) const;

 private:
  struct Parser;
  std::string text_;
  std::unique_ptr<Parser> parser_;
};

}  // namespace tether
