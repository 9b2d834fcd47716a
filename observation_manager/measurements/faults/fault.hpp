#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/config/overlay.hpp"
#include "observation_manager/measurements/faults/allowance.hpp"
#include "observation_manager/measurements/kind.hpp"
#include "observation_manager/measurements/triangle_surface.hpp"

namespace tether {

/// What a diagnosis calls a fault.
struct FaultName {
  std::string name, meaning;  ///< no name: it is not looked for
};

struct FaultDeclaration {
  FaultName of_all = {}, of_frame = {};  ///< of all frames of a source, of one
  bool (*concerns)(const Fallible& data) = nullptr;
  bool ruled_out_by_image = false;  ///< of all frames, where one is the imaged lumen that the model was made of
  bool on_request = false;          ///< looked for only where a diagnosis is told to (diagnosis.also)
};

/// A number of a fault: how large it is.
struct FaultNumber {
  std::string name, meaning;
  Dimension dimension;
  std::string unit = {};  ///< of what has no dimension: "rad"
  double lower = -infinite, upper = infinite;
  double scale = undefined;  ///< how large it may be; undefined: one unit
};

/// The data of a source beside a run, n of them.
struct SourceData {
  Eigen::Matrix3Xd places, normals;  ///< zero for values that are nowhere [length], out of the lumen
  VectorXd curvatures;               ///< sum of the lumen's two [1/length]
  VectorXd rate;                     ///< at which the run's lumen moves outward, or its value grows [their unit/time]
  VectorXd times;                    ///< in the run
  Vec3 middle{0, 0, 0};              ///< of the places [length]
  VectorXd values = {};              ///< as an instrument shows them; zero for what is none
  Dimension dimension = {};          ///< of the values
};

/// What a fault would do to data: by how much they lie farther out, or are larger, for each unit of each number.
struct FaultColumns {
  std::vector<FaultNumber> numbers;
  MatrixXd values;  ///< [n x numbers]
};

/// A fault that a diagnosis found.
struct FoundFault {
  std::map<std::string, double> numbers;
  Vec3 middle{0, 0, 0};   ///< of the data, as they are once what is known is taken off them [length]
  double time_shift = 0;  ///< as the case has it
  double number(const std::string& name) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? 0 : found->second;
  }
};

/// What data can be wrong in, with what a case says of it: how much of it is known and taken off the data of a source,
/// or how much of it a twin makes. One file each, listed in registry.cpp; what is below does nothing unless a fault
/// says otherwise.
class Fault {
 public:
  virtual ~Fault() = default;
  virtual const FaultDeclaration& declaration() const = 0;
  virtual std::unique_ptr<Fault> copy() const = 0;

  // How it is found. Standard deviations of each of its numbers that are no news; noise: deviation of the data.
  virtual FaultColumns columns(const SourceData&) const { return {}; }
  virtual double allowed(const AllowanceCase&, double /*noise*/) const { return 0; }
  virtual double allowed_of_frame(const AllowanceCase&) const { return 0; }

  // How it is taken off.
  /// What the case must say of the source, on top of what it says: fields by their place within the source.
  virtual std::vector<Overlay::Value> take_off(const FoundFault&) const { return {}; }
  /// Fields of the source's section `correction`, of values of this dimension.
  virtual void declare_correction(Fields&, Dimension) {}
  virtual Points corrected(Points points) const { return points; }
  /// Where a corrected point was.
  virtual Vec3 uncorrected(const Vec3& point) const { return point; }
  /// By how much the measured lumen is moved out [length].
  virtual double outward() const { return 0; }
  virtual double corrected_value(double value) const { return value; }
  /// What is done to points, for people; empty: nothing.
  virtual std::string note(const std::string& /*unit_of_length*/) const { return {}; }

  // How a twin makes it. Frames are counted from 0, lost ones too.
  /// Fields of `twin.faults`, or of a trace's `faults` there.
  virtual void declare_made(Fields&, Dimension) {}
  /// Throws InputError; where: "case.yaml:9: twin.faults".
  virtual void check_made(int /*frames*/, const std::string& /*where*/) const {}
  virtual bool loses(int /*frame*/) const { return false; }
  /// How much later than stated the frame shows the vessel [time].
  virtual double delay(int /*frame*/) const { return 0; }
  /// Added along the outward normals [length].
  virtual double moved_outward() const { return 0; }
  virtual void spoil(TriangleSurface&, const TriangleSurface& /*truth*/, int /*frame*/) const {}
  virtual double spoilt_value(double value) const { return value; }
};

/// A fault that is copied as a whole.
template <class Self>
class FaultOf : public Fault {
 public:
  std::unique_ptr<Fault> copy() const override { return std::make_unique<Self>(static_cast<const Self&>(*this)); }
};

/// The frame of a twin that a fault concerns.
struct ConcernedFrame {
  int number = -1;  ///< -1: all
  void declare(Fields& f);
  bool is(int frame) const { return number < 0 || number == frame; }
  /// Throws InputError if there is no such frame.
  void check(int frames, const std::string& where) const;
};

/// Three numbers of a case.
Vec3 vector_of(const std::vector<double>& numbers);  ///< none: zero
std::string list_text(const Vec3& v);                ///< "[0, 0.5, 0]"

}  // namespace tether
