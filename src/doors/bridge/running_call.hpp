#pragma once
// A call with its thread.
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "bridge/bridge.hpp"
#include "bridge/call.hpp"

struct RailstrataCall {
  explicit RailstrataCall(railstrata::bridge::Json arguments) : call(std::move(arguments)) {}
  railstrata::bridge::Call call;
  std::string answer;    ///< once it has ended
  std::string progress;  ///< the last one that was asked for
  std::mutex lock;
  std::condition_variable at_end;
  bool ended = false;
  std::thread thread;
};
