#pragma once

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/base/team.hpp"

namespace tether {

/// What the threads of a team share. One of them runs at a time, until it waits for the others: libraries that are not
/// made for threads (METIS) do not notice.
class ThreadRoom {
 public:
  explicit ThreadRoom(int size) : texts(static_cast<std::size_t>(size)), parcels(texts.size()), size_(size) {}

  void enter() { mutex_.lock(); }
  void leave() { mutex_.unlock(); }
  /// Until all have come here.
  void meet() {
    std::unique_lock lock(mutex_, std::adopt_lock);
    const int meeting = meetings_;
    if (++come_ == size_) {
      come_ = 0;
      ++meetings_;
      all_have_come_.notify_all();
    } else {
      all_have_come_.wait(lock, [&] { return meetings_ != meeting; });
    }
    lock.release();
  }

  std::vector<double> numbers;
  std::vector<std::string> texts;
  std::vector<std::vector<Team::Parcel>> parcels;  ///< outgoing, by sender

 private:
  int size_, come_ = 0, meetings_ = 0;
  std::mutex mutex_;
  std::condition_variable all_have_come_;
};

/// A team whose processes are threads of this one.
class ThreadTeam final : public Team {
 public:
  ThreadTeam(int rank, int size, ThreadRoom& room) : Team(rank, size), room_(room) {}
  using Team::sum;
  void sum(std::span<double> values) override {
    once([&] { room_.numbers.assign(values.size(), 0.0); });
    for (int turn = 0; turn < size(); ++turn) {
      if (turn == rank())
        for (std::size_t i = 0; i < values.size(); ++i) room_.numbers[i] += values[i];
      room_.meet();
    }
    std::copy(room_.numbers.begin(), room_.numbers.end(), values.begin());
    room_.meet();
  }
  void gather(std::span<double> all, std::span<const int> starts) override {
    once([&] { room_.numbers.assign(all.size(), 0.0); });
    const auto r = static_cast<std::size_t>(rank());
    std::copy(all.begin() + starts[r], all.begin() + starts[r + 1], room_.numbers.begin() + starts[r]);
    room_.meet();
    std::copy(room_.numbers.begin(), room_.numbers.end(), all.begin());
    room_.meet();
  }
  void exchange(std::span<const Parcel> outgoing, std::span<const Parcel> incoming) override {
    room_.parcels[static_cast<std::size_t>(rank())].assign(outgoing.begin(), outgoing.end());
    room_.meet();
    for (const Parcel& parcel : incoming)
      for (const Parcel& sent : room_.parcels[static_cast<std::size_t>(parcel.rank)])
        if (sent.rank == rank()) std::copy(sent.values.begin(), sent.values.end(), parcel.values.begin());
    room_.meet();
  }
  std::string text_of(int rank, const std::string& text) override {
    room_.texts[static_cast<std::size_t>(this->rank())] = text;
    room_.meet();
    const std::string result = room_.texts[static_cast<std::size_t>(rank)];
    room_.meet();
    return result;
  }
  int communicator() const override { return 0; }

 private:
  template <class Work>
  void once(const Work& work) {
    if (rank() == 0) work();
    room_.meet();
  }

  ThreadRoom& room_;
};

/// Calls body(team) in as many threads, and throws what the first of them throws. All of them must call the same
/// functions of the team.
template <class Body>
void in_team(int size, const Body& body) {
  ThreadRoom room(size);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(size));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank)
    threads.emplace_back([&, rank] {
      ThreadTeam team(rank, size, room);
      room.enter();
      try {
        body(team);
      } catch (...) {
        errors[static_cast<std::size_t>(rank)] = std::current_exception();
      }
      room.leave();
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace tether
