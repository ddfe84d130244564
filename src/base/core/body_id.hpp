#pragma once
// The two bodies of a rolling contact, and the one word of each: in case files, results and messages.
#include <array>
#include <cstddef>

namespace railstrata {

enum class BodyId { rail, wheel };

inline constexpr std::array kBodies{BodyId::rail, BodyId::wheel};

/// Place of a body in arrays of two.
constexpr std::size_t index_of(BodyId body) { return static_cast<std::size_t>(body); }

inline constexpr std::size_t kRail = index_of(BodyId::rail), kWheel = index_of(BodyId::wheel);

constexpr const char* body_word(BodyId body) {
  constexpr std::array words{"rail", "wheel"};
  return words[static_cast<std::size_t>(body)];
}

}  // namespace railstrata
