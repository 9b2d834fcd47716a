#include "pictures/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <vector>

#include "common/base/child_process.hpp"
#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

bool is_control(char c) {
  return std::iscntrl(static_cast<unsigned char>(c)) != 0;
}

/// The pictures that a script draws.
std::vector<std::string> outputs_of(const std::string& script) {
  const std::regex output("set output '([^']+)'");
  std::vector<std::string> all;
  for (std::sregex_iterator found(script.begin(), script.end(), output), end; found != end; ++found)
    all.push_back((*found)[1]);
  return all;
}

/// Whether its last block is there: gnuplot does not notice that a disk is full.
bool is_whole_png(const std::filesystem::path& file) {
  constexpr std::string_view last = "IEND";
  constexpr std::streamoff from_end = 8;  // its name and checksum
  std::ifstream from(file, std::ios::binary | std::ios::ate);
  if (!from || from.tellg() < from_end) return false;
  std::string found(last.size(), ' ');
  from.seekg(-from_end, std::ios::end).read(found.data(), static_cast<std::streamsize>(found.size()));
  return found == last;
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
  const std::filesystem::path file = output / "plots" / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream to(file);
  to << fmt::format("# Run in the output folder: gnuplot plots/{}\n", name) << script;
  to.close();
  if (!to) throw write_error(file);
  for (const std::string& picture : outputs_of(script)) std::filesystem::remove(output / picture);
  // not by a shell's cd, which goes by the text of a path, and through CDPATH elsewhere
  const ChildEnd end = capture({{"env", "--chdir=" + output.string(), "gnuplot", "plots/" + name}, {}});
  const std::string said = last_line(end.errors);
  if (end.exit_code != 0)
    throw run_error("{}: gnuplot {}{}{}", file.string(), how_it_ended(end.exit_code), said.empty() ? "" : ": ", said);
  for (const std::string& picture : outputs_of(script))
    if (!is_whole_png(output / picture)) throw write_error(output / picture);
}

}  // namespace tether
