#include "apps/quantity/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace splashdown::quantity {
namespace {

std::optional<Value> lookup(const std::string& name) {
  if (name == "t") return Value::column({1, 2, 3, 4});
  if (name == "y") return Value::column({2, 4, 7, 8});
  if (name == "key") return Value::column({0, 0, 1, 1});
  if (name == "ref.y") return Value::column({1, 2});
  if (name == "order") return Value::number(5);  // begins with the word "or"
  return std::nullopt;
}

double number(const std::string& text) { return evaluate_number(text, lookup); }

TEST(Expression, operators_bind_as_in_mathematics) {
  EXPECT_DOUBLE_EQ(number("1 + 2*3 - 4/2"), 5);
  EXPECT_DOUBLE_EQ(number("-2^2"), -4);
  EXPECT_DOUBLE_EQ(number("2^3^2"), 512);
  EXPECT_DOUBLE_EQ(number("2^-1"), 0.5);
  EXPECT_DOUBLE_EQ(number("(1 + 2)*3"), 9);
  EXPECT_DOUBLE_EQ(number("1e-3*1000"), 1);
  EXPECT_DOUBLE_EQ(number("8 - 4 - 2"), 2);
}

TEST(Expression, comparisons_are_weaker_than_sums_and_give_one_or_zero) {
  EXPECT_DOUBLE_EQ(number("1 + 1 <= 2 and 3 > 2"), 1);
  EXPECT_DOUBLE_EQ(number("1 == 2 or order >= 6"), 0);
}

TEST(Expression, columns_combine_row_by_row_and_with_numbers) {
  EXPECT_EQ(evaluate("2*t + y", lookup).numbers, (std::vector<double>{4, 8, 13, 16}));
  EXPECT_DOUBLE_EQ(number("sum(select(y, t > 1 and t < 4))"), 11);
}

TEST(Expression, functions_reduce_columns) {
  EXPECT_DOUBLE_EQ(number("mean(y)"), 5.25);
  EXPECT_DOUBLE_EQ(number("mean(y, t)"), 16.0 / 3);
  EXPECT_DOUBLE_EQ(number("interp(t, y, 2.5)"), 5.5);
  EXPECT_DOUBLE_EQ(number("argmax(-abs(t - 3), t)"), 3);
  EXPECT_DOUBLE_EQ(number("max(column(1, order, 3))"), 5);
  EXPECT_EQ(evaluate("group_max(y, key)", lookup).numbers, (std::vector<double>{4, 8}));
  EXPECT_EQ(evaluate("group_argmax(-y, key, t)", lookup).numbers, (std::vector<double>{1, 3}));
}

TEST(Expression, nan_passes_through_extremes) {
  EXPECT_TRUE(std::isnan(number("max(column(1, 0/0, 3))")));
  EXPECT_TRUE(std::isnan(number("min(column(1, 2, 0/0))")));
}

TEST(Expression, mistakes_are_refused) {
  for (const char* text : {"", "1 +", "(1", "nothing", "mean()", "unknown(1)", "1 2", "t + ref.y", "t",
                           "slope(t, ref.y)", "mean(select(y, t > 9))", "3 $ 4"})
    EXPECT_THROW(number(text), std::runtime_error) << text;
}

TEST(Expression, message_quotes_expression_and_place) {
  try {
    number("1 + nothing");
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("nothing"), std::string::npos);
    EXPECT_NE(message.find("1 + nothing"), std::string::npos);
  }
}

}  // namespace
}  // namespace splashdown::quantity
