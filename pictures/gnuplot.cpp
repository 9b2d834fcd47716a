#include "pictures/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "common/base/child_process.hpp"
#include "common/base/error.hpp"

namespace tether {
namespace {

bool is_control(char c) {
  return std::iscntrl(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

bool has_gnuplot() {
  return capture({{"sh", "-c", "command -v gnuplot"}, {}}).exit_code == 0;
}

std::string gnuplot_head(int width, int height) {
  return fmt::format("set terminal pngcairo noenhanced size {},{} font 'sans,12'\nset grid\n", width, height);
}

std::string gnuplot_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += is_control(c) ? ' ' : c;
  }
  return quoted + "'";
}

std::string gnuplot_cell(const std::string& text) {
  std::string cell = text;
  std::replace_if(cell.begin(), cell.end(), is_control, ' ');
  std::replace(cell.begin(), cell.end(), '"', '\'');
  return '"' + cell + '"';
}

void run_gnuplot(const std::filesystem::path& output, const std::string& name, const std::string& script) {
  std::filesystem::create_directories(output / "plots");
  std::ofstream(output / "plots" / name) << fmt::format("# Run in the output folder: gnuplot plots/{}\n", name)
                                         << script;
  const ChildEnd end = capture({{"sh", "-c", "cd \"$0\" && exec gnuplot \"plots/$1\"", output.string(), name}, {}});
  if (end.exit_code != 0) throw run_error("{}: gnuplot failed: {}", (output / "plots" / name).string(), end.errors);
}

}  // namespace tether
