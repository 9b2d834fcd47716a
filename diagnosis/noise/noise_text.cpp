#include "diagnosis/noise/noise_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "pictures/gnuplot.hpp"

namespace tether {
namespace {

std::string interval_text(const MeasuredNumber& number, const std::string& unit, double scale = 1) {
  return fmt::format("{:.3g}{}{} ({:.3g} .. {:.3g})", scale * number.value, unit.empty() ? "" : " ", unit,
                     scale * number.lower, scale * number.upper);
}

/// "0.0151 cm"
std::string quantity(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

bool lasts(const MeasuredNoise& noise) {
  return noise.correlation_time && noise.correlation_time->lower > 0;
}

std::string line_of(const MeasuredNoise& noise) {
  const NoiseFit& fit = noise.fits.front();
  std::string line =
      fmt::format("noise: {{deviation: {}, correlation_length: {}", quantity(fit.deviation.value, noise.unit),
                  quantity(fit.correlation_length.value, noise.unit));
  if (lasts(noise)) line += fmt::format(", correlation_time: {}", quantity(noise.correlation_time->value, "s"));
  return line + "}";
}

std::string shape_text(const MeasuredNoise& noise) {
  const bool exponential = noise.fits.front().shape == CorrelationShape::exponential;
  return fmt::format("{} shape fits better{} (log likelihood higher by {:.1f})",
                     exponential ? "an exponential" : "a Gaussian",
                     noise.shape_is_told ? "" : ", but not significantly", noise.shape_difference);
}

std::string time_text(const MeasuredNoise& noise) {
  if (!noise.correlation_time) return "";
  if (!lasts(noise)) return fmt::format("; no longer than {:.3g} s", noise.correlation_time->upper);
  return "; lasting " + interval_text(*noise.correlation_time, "s");
}

std::string sentence_of(const MeasuredNoise& noise) {
  const NoiseFit& fit = noise.fits.front();
  return fmt::format("{}, from {}: deviation {}, correlation length {}{}, {} % of the variance alike nowhere{}; {}",
                     noise.source, meaning_of(noise.from), interval_text(fit.deviation, noise.unit),
                     interval_text(fit.correlation_length, noise.unit), noise.reaches_end ? ", or longer" : "",
                     interval_text(fit.nugget, "", 100), time_text(noise), shape_text(noise));
}

std::string file_of(const MeasuredNoise& noise) {
  std::string name = fmt::format("noise_{}_{}", word_of(noise.from), noise.source);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

std::string script_of(const MeasuredNoise& noise, const std::string& file) {
  std::string rows = "$bins << END\n";
  for (const CorrelationBin& bin : noise.correlation)
    rows += fmt::format("{} {} {} {}\n", bin.distance, bin.measured, bin.exponential, bin.gaussian);
  return gnuplot_head(900, 520) + rows + "END\n" +
         fmt::format(
             "set output 'plots/{}.png'\nset title {}\nset xlabel {}\nset ylabel 'correlation of what is left'\n"
             "plot $bins using 1:2 with points pointtype 7 title 'measured', '' using 1:3 with lines linewidth 2 "
             "title 'exponential fit', '' using 1:4 with lines linewidth 2 title 'Gaussian fit'\n",
             file, gnuplot_text(fmt::format("{}, {}", noise.source, meaning_of(noise.from))),
             gnuplot_text(noise.unit.empty() ? "distance" : "distance [" + noise.unit + "]"));
}

}  // namespace

MeasuredNoise measured_noise(const SeenNoise& seen, const std::string& unit) {
  MeasuredNoise noise = measured_noise(seen.fields, seen.stated);
  noise.from = seen.from;
  noise.source = seen.source;
  noise.frames = seen.frames;
  noise.unit = unit;
  noise.line = line_of(noise);
  if (noise.stated) noise.stated->source = seen.source;
  return noise;
}

std::vector<std::string> sentences_of(const std::vector<MeasuredNoise>& measurements) {
  std::vector<std::string> all;
  for (const MeasuredNoise& noise : measurements) all.push_back(sentence_of(noise));
  for (const MeasuredNoise& noise : measurements)
    if (noise.stated && noise.stated->contradicts) all.push_back(sentence_of(*noise.stated));
  return all;
}

std::string text_of(const NoiseMeasurements& noise) {
  std::string text = "\n";
  for (const std::string& sentence : noise.sentences) text += sentence + "\n";
  for (const MeasuredNoise& one : noise.measurements)
    text += fmt::format("\n{}, from {}\n  frames {}\n  {}\n", one.source, meaning_of(one.from),
                        fmt::join(one.frames, ", "), one.line);
  return text;
}

std::vector<std::string> draw_noise(const NoiseMeasurements& noise, const std::filesystem::path& output) {
  if (!has_gnuplot()) return {};
  std::vector<std::string> names;
  for (const MeasuredNoise& one : noise.measurements) {
    const std::string file = file_of(one);
    run_gnuplot(output, file + ".gp", script_of(one, file));
    names.push_back(file + ".png");
  }
  return names;
}

}  // namespace tether
