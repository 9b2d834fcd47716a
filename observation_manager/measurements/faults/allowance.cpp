#include "observation_manager/measurements/faults/allowance.hpp"

namespace tether {

void LastingAllowance::declare(Fields& f) {
  f.number("model", model, dimension::length, range::not_negative,
           "of the model's lumen in a region, by its mesh and time step; absent: a quarter of the noise's deviation");
  f.number("bias", bias, dimension::length, range::not_negative,
           "of all measured lumens along their normals, as by a threshold; absent: half the noise's deviation");
  f.number("displacement", displacement, dimension::length, range::not_negative,
           "of all measured lumens as rigid bodies, in each direction; absent: half the noise's deviation");
}

void AllowanceCase::declare(Fields& f) {
  f.number("inputs", inputs, dimension::none, range::not_negative,
           "of each number that the model takes for known, relative to itself");
  LastingAllowance::declare(f);
  f.number("frame_displacement", frame_displacement, dimension::length, range::not_negative,
           "of each frame by itself, in each direction");
  f.number("time_shift", time_shift, dimension::time, range::not_negative,
           "of the times of all frames, and of the model: absent: half its time step");
}

}  // namespace tether
