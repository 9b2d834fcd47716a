#pragma once

#include <span>
#include <string>

#include "common/base/error.hpp"

namespace tether {

/// The processes that compute one model together (coupling.ranks). Each of them calls the same functions in the same
/// order, and gets the same bits. A model in one process has a team of one.
class Team {
 public:
  Team(int rank, int size) : rank_(rank), size_(size) {}
  virtual ~Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_alone() const { return size_ == 1; }

  /// Each number becomes its sum over the processes.
  virtual void sum(std::span<double> values) = 0;
  /// `all` has a part for each process, that of rank r from starts[r] to starts[r + 1]; each brings its own.
  virtual void gather(std::span<double> all, std::span<const int> starts) = 0;

  /// Numbers to or from another process.
  struct Parcel {
    int rank = 0;
    std::span<double> values;
  };
  /// Who sends to whom is known to both.
  virtual void exchange(std::span<const Parcel> outgoing, std::span<const Parcel> incoming) = 0;

  /// What the process of this rank has as `text`.
  virtual std::string text_of(int rank, const std::string& text) = 0;

  /// Fortran handle of an MPI communicator of these processes and nobody else. Throws InternalError where there is
  /// none: in a team of one.
  virtual int communicator() const = 0;

  double sum(double value) {
    sum(std::span(&value, 1));
    return value;
  }
  /// The least of the processes' values, and the first of those that have it.
  struct Least {
    double value = 0;
    int rank = 0;
  };
  Least least(double value);
  /// Work that needs no other process. Where it fails in one, all throw RunError with what the first of them said.
  template <class Work>
  void each(const Work& work) {
    std::string failure;
    bool failed = false;
    try {
      work();
    } catch (const RunError& error) {
      failed = true;
      failure = error.what();
    }
    throw_if_any(failed, failure);
  }

 private:
  void throw_if_any(bool failed, const std::string& failure);

  int rank_, size_;
};

/// A team of one.
Team& alone();

}  // namespace tether
