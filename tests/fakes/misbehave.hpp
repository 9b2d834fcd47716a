#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "common/base/error.hpp"

namespace tether::fakes {

/// The option NAME of the environment variable TETHER_FAKE="role.NAME=VALUE ...", or "".
inline std::string option(const std::string& role, const std::string& name) {
  const char* text = std::getenv("TETHER_FAKE");
  const std::string options = std::string(" ") + (text ? text : "") + " ", key = " " + role + "." + name + "=";
  const auto start = options.find(key);
  if (start == std::string::npos) return "";
  return options.substr(start + key.size(), options.find(' ', start + 1) - start - key.size());
}

/// Leaves an empty file TETHER_FAKE_STAMP, whose time is that of the fault (benchmarks/failure).
inline void stamp() {
  if (const char* file = std::getenv("TETHER_FAKE_STAMP")) std::ofstream stamp(file);
}

/// What the fake called `role` is told to do wrong at `point` (a message's name, "start" or "hello").
inline void misbehave(const std::string& role, const std::string& point) {
  for (const char* fault : {"kill", "exit", "hang", "stop", "refuse", "fail"})
    if (option(role, fault) == point) stamp();
  if (option(role, "kill") == point) std::raise(SIGKILL);
  if (option(role, "stop") == point) std::raise(SIGSTOP);
  if (option(role, "exit") == point) std::_Exit(0);
  if (option(role, "linger") == point) std::this_thread::sleep_for(std::chrono::seconds(8));
  if (option(role, "hang") == point) std::this_thread::sleep_for(std::chrono::hours(1));
  if (option(role, "refuse") == point) throw input_error("case.yaml:7: {}.density: -1 g/cm3: must be positive", role);
  if (option(role, "fail") == point) throw run_error("element 12 is inverted");
}

/// A fake with these faults: every message is first checked against TETHER_FAKE.
template <class Fake>
struct Misbehaving : Fake {
  std::string role;
  Misbehaving(std::string name, Fake fake) : Fake(std::move(fake)), role(std::move(name)) {}
  template <class Request>
  typename Request::Reply operator()(const Request& request) {
    misbehave(role, Request::message_name);
    return Fake::operator()(request);
  }
};

}  // namespace tether::fakes
