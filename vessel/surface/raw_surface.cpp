#include "vessel/surface/raw_surface.hpp"

namespace tether {

double in_cm(const std::string& unit) {
  return unit == "mm" ? 0.1 : unit == "m" ? 100 : 1;
}

std::string text_of_place(const Vec3& place) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) cm", place[0], place[1], place[2]);
}

std::string text_of(const RepairNote& note) {
  const std::string size = note.size > 0 ? fmt::format(", {:.3g} in size", note.size) : "";
  return fmt::format("{} {}: {}{}, at {}", note.count, word_of(note.kind), meaning_of(note.kind), size,
                     text_of_place(note.place));
}

}  // namespace tether
