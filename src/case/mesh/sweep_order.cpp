#include "mesh/sweep_order.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace railstrata {
namespace {

std::vector<int> greedy_order(const Section& section) {
  const auto& quads = section.quads;
  const int count = static_cast<int>(quads.size());
  std::vector<std::vector<int>> at_node(section.nodes.size());
  for (int q = 0; q < count; ++q)
    for (int n : quads[q]) at_node[n].push_back(q);
  std::vector<char> open(section.nodes.size(), 0), ordered(quads.size(), 0), waits(quads.size(), 0);
  auto new_nodes = [&](int q) {
    return static_cast<int>(std::count_if(quads[q].begin(), quads[q].end(), [&](int n) { return !open[n]; }));
  };
  auto shared = [&](int q, int p) {
    return static_cast<int>(std::count_if(quads[q].begin(), quads[q].end(), [&](int n) {
      return std::find(quads[p].begin(), quads[p].end(), n) != quads[p].end();
    }));
  };
  auto loneliest = [&] {  // the least busy corner of what is left
    int best = -1, least = 0;
    for (int q = 0; q < count; ++q) {
      if (ordered[q]) continue;
      int busy = 0;
      for (int n : quads[q]) busy += static_cast<int>(at_node[n].size());
      if (best < 0 || busy < least) {
        best = q;
        least = busy;
      }
    }
    return best;
  };

  std::vector<int> order, waiting;  // waiting: at open nodes, by the time they came
  order.reserve(quads.size());
  while (static_cast<int>(order.size()) < count) {
    int next;
    if (waiting.empty()) {
      next = loneliest();
    } else {
      next = *std::min_element(waiting.begin(), waiting.end(), [&](int a, int b) {
        return std::tuple(new_nodes(a), -shared(a, order.back())) < std::tuple(new_nodes(b), -shared(b, order.back()));
      });
      waiting.erase(std::find(waiting.begin(), waiting.end(), next));
    }
    order.push_back(next);
    ordered[next] = 1;
    for (int n : quads[next]) {
      open[n] = 1;
      for (int q : at_node[n])
        if (!ordered[q] && !waits[q]) {
          waits[q] = 1;
          waiting.push_back(q);
        }
    }
  }
  return order;
}

}  // namespace

int widest_front(const Section& section, const std::vector<int>& order) {
  std::vector<int> left(section.nodes.size(), 0);
  for (const auto& q : section.quads)
    for (int n : q) ++left[n];
  std::vector<char> open(section.nodes.size(), 0);
  int now = 0, widest = 0;
  for (int q : order) {
    for (int n : section.quads[q]) {
      if (!open[n]) {
        open[n] = 1;
        ++now;
      }
      if (--left[n] == 0) --now;
    }
    widest = std::max(widest, now);
  }
  return widest;
}

std::vector<int> sweep_order(const Section& section) {
  constexpr double kMuchNarrower = 0.6;
  std::vector<int> own(section.quads.size());
  std::iota(own.begin(), own.end(), 0);
  std::vector<int> greedy = greedy_order(section);
  return widest_front(section, greedy) < kMuchNarrower * widest_front(section, own) ? greedy : own;
}

}  // namespace railstrata
