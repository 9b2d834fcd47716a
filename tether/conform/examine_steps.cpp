/// What the partner computes in a step, and its derivatives.
#include "tether/conform/examiner.hpp"

namespace tether::protocol {

std::string Examiner::evaluate() {
  drive_->calibrate();
  const Numbers response = begin_and_evaluate(1);
  drive_->evaluate(0);  // at rest, where a run begins
  end(false);
  const std::size_t expected = surface_.points.size() * (partner_.role() == "fluid" ? 1 : 2);
  require(response.size() == expected, "the reply has {} numbers instead of {}", response.size(), expected);
  require(all_finite(response), "the reply is not finite");
  return fmt::format("largest entry {:.3g} for an excitation of {:.3g}", largest(response),
                     largest(drive_->excitation(1)));
}

std::string Examiner::repeat() {
  const Numbers first = begin_and_evaluate(1);
  drive_->evaluate(0.5);
  const double change = difference(first, drive_->evaluate(1));
  end(false);
  require(change <= repeat_tolerance, "relative difference {:.2g} > {:.0g}", change, repeat_tolerance);
  return fmt::format("relative difference {:.2g}", change);
}

/// Of two loads in one step displacements differ by dt times what velocities do, whatever the state before it.
std::string Examiner::mean_velocity() {
  if (partner_.role() != "solid") throw Skipped("of a solid");
  const Numbers one = begin_and_evaluate(1), other = drive_->evaluate(-0.5);
  end(false);
  const Numbers changes = combined(1, one, -1, other);
  const auto half = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  const Numbers moved(changes.begin(), half), velocity(half, changes.end());
  const double error = difference(combined(dt_, velocity, 0, velocity), moved);
  require(
      error <= mean_velocity_tolerance,
      "displacements of two loads differ by {:.2g} from dt times their velocities: the velocity must be (y1 - y0)/dt",
      error);
  return fmt::format("relative difference {:.2g}", error);
}

/// A load does work on the motion that it makes.
std::string Examiner::yielding() {
  if (partner_.role() != "solid") throw Skipped("of a solid");
  const Numbers pushed = begin_and_evaluate(1), free = drive_->evaluate(0);
  end(false);
  const Numbers changes = combined(1, pushed, -1, free);
  const Numbers moved(changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2));
  require(dot(moved, moved) > 0, "a load does not move it");
  require(dot(drive_->excitation(1), moved) > 0,
          "a load moves it the other way: a load is the force of the fluid on it");
  return "";
}

std::string Examiner::reject() {
  const Numbers first = begin_and_evaluate(1);
  drive_->evaluate(-1);
  end(false);
  const double change = difference(first, begin_and_evaluate(1));
  end(false);
  drive_->begin();
  end(false);  // without any evaluation
  require(change <= repeat_tolerance, "relative difference {:.2g} > {:.0g}", change, repeat_tolerance);
  return fmt::format("relative difference {:.2g}", change);
}

std::string Examiner::accept() {
  begin_and_evaluate(1);
  const StepReport report = end(true);
  const std::size_t announced = partner_.hello().observables.size();
  require(report.observables.size() == announced, "{} observables announced, {} reported", announced,
          report.observables.size());
  require(all_finite(report.observables), "an observable is not finite");
  begin_and_evaluate(1.1);
  end(true);
  return "";
}

std::string Examiner::tangent() {
  if (!partner_.hello().has_tangent) throw Skipped("not announced");
  constexpr double h = 0.01;
  begin_and_evaluate(1);
  const Numbers up = drive_->evaluate(1, h), down = drive_->evaluate(1, -h);
  drive_->evaluate(1);
  const Numbers change = drive_->tangent();
  end(false);
  require(change.size() == up.size(), "the reply has {} numbers instead of {}", change.size(), up.size());
  const Numbers expected = combined(0.5 / h, up, -0.5 / h, down);
  const double error = difference(change, expected);
  require(error <= tangent_tolerance, "relative error {:.2g} > {:.0g}", error, tangent_tolerance);
  return fmt::format("relative error {:.2g}", error);
}

Numbers Examiner::unknowns(double phase) const {
  Numbers values(static_cast<std::size_t>(partner_.hello().unknowns));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(phase + 0.37 * static_cast<double>(i * i % 101));
  return values;
}

/// At a place beneath each triangle of the interface, a twentieth of its size deep; and far away.
std::string Examiner::velocity() {
  if (!partner_.hello().has_velocity) throw Skipped("not announced");
  Numbers places = beneath(surface_);
  const std::size_t inside = places.size();
  for (const double far : {1e6, 1e6, 1e6}) places.push_back(far);
  const Numbers found = partner_.ask(GetVelocity{places}).values;
  require(found.size() == places.size(), "{} numbers instead of {}", found.size(), places.size());
  require(all_finite({found.begin(), found.begin() + static_cast<std::ptrdiff_t>(inside)}),
          "no velocity at a place inside the lumen");
  for (std::size_t i = inside; i < found.size(); ++i)
    require(std::isnan(found[i]), "a velocity at a place outside the lumen: must be NaN");
  return fmt::format("{} places", inside / 3);
}

std::string Examiner::operators() {
  if (!partner_.hello().has_operators) throw Skipped("not announced");
  drive_->begin();
  in_step_ = true;
  partner_.ask(SolidResidual{{}, drive_->excitation(1)});
  const Numbers a = unknowns(0.1), b = unknowns(1.7);
  const Numbers ka = partner_.ask(SolidProduct{a}).values, kb = partner_.ask(SolidProduct{b}).values;
  const Numbers pa = partner_.ask(SolidPrecondition{a}).values, pb = partner_.ask(SolidPrecondition{b}).values;
  end(false);
  for (const Numbers* reply : {&ka, &kb, &pa, &pb})
    require(reply->size() == a.size(), "a reply has {} numbers instead of {}", reply->size(), a.size());
  const auto asymmetry = [&](const Numbers& xa, const Numbers& xb) {
    return std::abs(dot(a, xb) - dot(b, xa)) / std::sqrt(std::abs(dot(a, xa) * dot(b, xb)));
  };
  require(dot(a, ka) > 0 && dot(b, kb) > 0, "the product is not positive");
  require(asymmetry(ka, kb) <= symmetry_tolerance, "product: asymmetry {:.2g}", asymmetry(ka, kb));
  require(asymmetry(pa, pb) <= preconditioner_tolerance, "preconditioner: asymmetry {:.2g}", asymmetry(pa, pb));
  return fmt::format("asymmetry {:.2g} and {:.2g}", asymmetry(ka, kb), asymmetry(pa, pb));
}

std::string Examiner::operator_derivative() {
  if (!partner_.hello().has_operators) throw Skipped("not announced");
  const Numbers load = drive_->excitation(1);
  drive_->begin();
  in_step_ = true;
  const SolidResidualReply start = partner_.ask(SolidResidual{{}, load});
  // One preconditioned correction is a direction of the right size.
  Numbers direction = partner_.ask(SolidPrecondition{start.residual}).values;
  direction = combined(0.01, direction, 0, direction);
  const Numbers product = partner_.ask(SolidProduct{direction}).values;
  const SolidResidualReply up = partner_.ask(SolidResidual{direction, load});
  const SolidResidualReply down = partner_.ask(SolidResidual{combined(-2, direction, 0, direction), load});
  end(false);
  const double error = difference(product, combined(-0.5, up.residual, 0.5, down.residual));
  require(error <= tangent_tolerance, "relative error {:.2g} > {:.0g}", error, tangent_tolerance);
  Numbers moved = combined(1 / dt_, up.displacement, -1 / dt_, down.displacement);
  const double kinematics = difference(moved, combined(1, up.velocity, -1, down.velocity));
  require(kinematics <= 1e-6, "displacement and dt times velocity differ by {:.2g}", kinematics);
  return fmt::format("relative error {:.2g}", error);
}

}  // namespace tether::protocol
