#include "twin/twin_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "observation_manager/measurements/trace_case.hpp"

namespace tether {
void TwinImageCase::declare(Fields& f) {
  f.numbers("voxel", voxel, {3, dimension::length, range::not_negative},
            "size of a voxel in x, y, z; absent: 0.6 x 0.6 x 1 mm; [0, 0, 0]: no image, the truth's surface itself");
  f.number("blur", blur, dimension::length, range::not_negative,
           "standard deviation of the image's unsharpness; absent: none");
  f.flag("mask", mask,
         "whether voxels are marked as inside or outside, as by hand; false: the level 1/2 of the grey values");
  f.integer("smoothing", smoothing, {0, 1000}, "passes that smooth the voxels' steps away");
}

void TwinTraceCase::declare(Fields& f) {
  f.text("observable", observable, "column of timeseries.csv: fluid.outlet.pressure", Need::required);
  declare_quantity(f, quantity, noise.dimension);
  faults.dimension = noise.dimension;
  f.number("interval", interval, dimension::time, range::positive, "time between two values");
  f.group("noise", noise, "errors of the values");
  f.group("faults", faults, "what is wrong with all values");
}

void HiddenEffectCase::declare(Fields& f) {
  f.text("effect", effect, "its name as diagnosis.json has it; absent: that of this entry");
  f.text("where", where, "the region, ring or opening that it acts on; absent: any");
  f.number("amplitude", amplitude, dimension::none, range::any, "its strength");
  f.text("unit", unit, "of the amplitude, as diagnosis.json has it");
}

void HiddenCase::declare(Fields& f) {
  std::string word = word_of(verdict);
  std::vector<Word> words;
  for (const auto& known : words_of<Verdict>) words.push_back({known.word, known.meaning});
  f.choice("verdict", word, words, "what a diagnosis should say");
  verdict = *from_word<Verdict>(word);  // one of them, or the default
  f.groups("effects", effects, "effects that the truth has and the model lacks, by name");
  const bool named = verdict == Verdict::missing || verdict == Verdict::ambiguous;
  f.check(named == !effects.empty(), "verdict",
          "must be 'missing' or 'ambiguous' with effects, and another one without");
}

void TwinCase::declare(Fields& f) {
  f.path("truth", truth, "case file of the run that the data are made from", Need::required);
  f.integer("seed", seed, {0}, "of the noise: the same seed gives the same data");
  f.integer("frames", frames, {1, 10000}, "surfaces in a beat");
  f.number("beat", beat, dimension::time, range::positive, "duration of a beat; absent: the case's whole run");
  f.number("first", first, dimension::time, range::any,
           "time of the first frame; absent: such that the last one is at the end of the run");
  f.flag("periodic", periodic,
         "whether the frames stand for every beat; false: for the moments at which they were taken");
  f.numbers("held_out", held_out, {0, dimension::none, range::not_negative},
            "numbers of frames (from 0, of those that are not lost) that no number is fitted to: they judge");
  f.group("image", image, "how the lumen is imaged and segmented");
  f.group("noise", noise, "errors along the normal that are added to the surfaces");
  f.group("faults", faults, "what goes wrong with the data");
  f.groups("traces", traces, "traces to be measured, by name");
  f.group("hidden", hidden, "the answer, sealed away from everything but tether score");
  int kept = 0;
  for (int frame = 0; frame < frames; ++frame) kept += faults.lose(frame) ? 0 : 1;
  f.check(std::all_of(held_out.begin(), held_out.end(),
                      [&](double number) { return number < kept && number == std::floor(number); }),
          "held_out", fmt::format("must be whole numbers, from 0 to {}: of the frames that are kept", kept - 1));
}

}  // namespace tether
