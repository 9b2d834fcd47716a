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

/// Of the variance: a deviation from the rest is less than a fifth too small, which is no matter (measured_noise.cpp).
constexpr double mostly_shown = 1 / (1.2 * 1.2);

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

std::string shown_text(const MeasuredNoise& noise) {
  if (!noise.shown) return "";
  return fmt::format(", of the {:.0f} % that does not last from one to the next", 100 * *noise.shown);
}

std::string sentence_of(const MeasuredNoise& noise) {
  const NoiseFit& fit = noise.fits.front();
  return fmt::format("{}, from {}{}: deviation {}, correlation length {}{}, {} % of the variance alike nowhere{}; {}",
                     noise.source, meaning_of(noise.from), shown_text(noise), interval_text(fit.deviation, noise.unit),
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

/// Share of the variance that the differences of frames so far apart show, of errors that last.
double share_shown(const std::vector<double>& apart, double correlation_time) {
  if (apart.empty() || correlation_time <= 0) return 1;
  double sum = 0;
  for (const double between : apart) sum -= std::expm1(-between / correlation_time);
  return sum / static_cast<double>(apart.size());
}

/// What is stated, as these frames would show it.
Noise expected_of(const SeenNoise& seen) {
  Noise expected = seen.stated;
  expected.deviation *= std::sqrt(share_shown(seen.apart, seen.stated.correlation_time));
  return expected;
}

/// Differences of frames do not last as errors do.
void forget_times(MeasuredNoise& noise, const Noise& stated) {
  noise.correlation_time.reset();
  if (!noise.stated) return;
  noise.stated->deviation = stated.deviation;
  noise.stated->measured_time.reset();
  noise.stated->time_contradicts = false;
}

}  // namespace

MeasuredNoise measured_noise(const SeenNoise& seen, const std::string& unit) {
  MeasuredNoise noise = measured_noise(seen.fields, expected_of(seen));
  if (seen.from == NoiseOrigin::rest) forget_times(noise, seen.stated);
  noise.from = seen.from;
  noise.source = seen.source;
  noise.frames = seen.frames;
  noise.unit = unit;
  noise.line = line_of(noise);
  if (noise.stated) noise.stated->source = seen.source;
  return noise;
}

std::vector<MeasuredNoise> measured_noise(const std::vector<SeenNoise>& seen, const std::string& unit) {
  std::vector<MeasuredNoise> all;
  for (const SeenNoise& one : seen) all.push_back(measured_noise(one, unit));
  for (std::size_t i = 0; i < all.size(); ++i) {
    MeasuredNoise& rest = all[i];
    if (rest.from != NoiseOrigin::rest) continue;
    for (const MeasuredNoise& left : all)
      if (left.from == NoiseOrigin::residual && left.source == rest.source && lasts(left))
        rest.shown = share_shown(seen[i].apart, left.correlation_time->value);
    if (!rest.shown || *rest.shown >= mostly_shown) continue;
    rest.stated.reset();
    rest.line.clear();
  }
  return all;
}

std::vector<std::string> sentences_of(const std::vector<MeasuredNoise>& measurements) {
  std::vector<std::string> all;
  for (const MeasuredNoise& noise : measurements) all.push_back(sentence_of(noise));
  for (const MeasuredNoise& noise : measurements)
    if (noise.stated && is_contradicted(*noise.stated)) all.push_back(sentence_of(*noise.stated));
  return all;
}

std::string text_of(const NoiseMeasurements& noise) {
  std::string text = "\n";
  for (const std::string& sentence : noise.sentences) text += sentence + "\n";
  for (const MeasuredNoise& one : noise.measurements)
    text +=
        fmt::format("\n{}, from {}\n  frames {}\n  {}\n", one.source, meaning_of(one.from), fmt::join(one.frames, ", "),
                    one.line.empty() ? "errors last: take the noise from what the run leaves" : one.line);
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
