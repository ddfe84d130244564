#include "options/option_slots.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;

template <auto Member>
constexpr auto crack = at<&CaseSpec::life, &LifeSpec::crack, Member>;

bool cracked(const CaseSpec& spec, std::size_t) { return spec.life.crack.there(); }
bool downwards(const CaseSpec& spec, std::size_t) { return spec.life.crack.depth > 0; }
bool level(const CaseSpec& spec, std::size_t) { return spec.life.crack.level(); }
bool followed(const CaseSpec& spec, std::size_t) { return spec.life.crack.depth > 0 && spec.life.until > 0; }

std::vector<Option> growth_options() {
  return {choice<&CrackSpec::law>(
              "law", crack<&CrackSpec::law>,
              "Growth law. shear: in its own plane under shear [Bold1991]; paris: the most that EN 13674-1 allows a "
              "rail in tension, of the root of the squares of both ranges",
              {{"shear", GrowthLaw::shear}, {"paris", GrowthLaw::paris}})
              .where(downwards),
          option("threshold", crack<&CrackSpec::threshold>,
                 "Range of the law's equivalent stress intensity without growth", kToughness, {0, 5e7})
              .where(downwards),
          option("detectable", crack<&CrackSpec::detectable>, "Depth of a crack that an inspection finds", kLength,
                 above(0, 0.05))
              .where(followed),
          option("allowable", crack<&CrackSpec::allowable>, "Depth of a crack that ends the rail's life", kLength,
                 above(0, 0.05))
              .where(downwards)};
}

}  // namespace

OptionTable crack_table() {
  OptionTable out = {
      "crack",
      "A straight crack in the rail: stress intensities over a passage and growth",
      {option("depth", crack<&CrackSpec::depth>,
              "Depth of its lower end below the surface. 0: no crack goes down. In a life (life.until) the depth at "
              "which growth begins when the metal has cracked; shallower ones are too short for stress intensities",
              kLength, {0, 0.05}),
       option("top", crack<&CrackSpec::top>,
              "Depth of its upper end: a crack inside the rail. 0: it begins at the surface", kLength, {0, 0.05})
           .where(downwards),
       option("length", crack<&CrackSpec::length>,
              "Length of a crack along an interface of the rail's layers, in place of crack.depth. 0: there is none",
              kLength, {0, 0.1}),
       option("layer", crack<&CrackSpec::layer>, "Layer, from the surface, along whose lower interface it lies",
              kNumber, {1, 100})
           .where(level),
       option("angle", crack<&CrackSpec::angle>, "Between the crack and the surface", kAngle, {0.26, 1.58})
           .where(downwards),
       option("azimuth", crack<&CrackSpec::azimuth>,
              "Direction in which the crack goes down, from that of rolling towards the field side: 0 along the "
              "rail, \"180 deg\" against the rolling. Not given: the direction in which it grows fastest",
              kAngle, {-3.15, 3.15})
           .where(cracked),
       option("lateral", crack<&CrackSpec::lateral>,
              "Place across, from where the pressure of the patch is largest, positive to the field side. In a "
              "life the crack is where the metal fails first",
              kLength, {-0.03, 0.03})
           .where(cracked),
       option("place", crack<&CrackSpec::place>,
              "Of a life: a crack that is there from the beginning, so far from the rail's axis, positive to the "
              "field side. Not given: it begins where and when the metal fails first",
              kLength, {-0.05, 0.05})
           .where(followed),
       option("face_friction", crack<&CrackSpec::face_friction>,
              "Friction coefficient between the faces of the crack; 0.1 to 0.4 in the literature", kNumber, {0, 1})
           .where(cracked),
       choice<&CrackSpec::fluid>(
           "fluid", crack<&CrackSpec::fluid>,
           "What fills the crack. mouth: a fluid at the pressure of the patch over the mouth; trapped: a fluid "
           "whose volume stays while the patch lies over the mouth",
           {{"none", CrackFluid::none}, {"mouth", CrackFluid::mouth}, {"trapped", CrackFluid::trapped}})
           .where(downwards),
       option("aspect", crack<&CrackSpec::aspect>,
              "Half the crack's length at the surface over its length downwards: factors of a half ellipse. A large "
              "number: a straight front",
              kNumber, {1, 1e6})
           .where(downwards)},
      {},
      {}};
  append(out.options, growth_options());
  return out;
}

}  // namespace railstrata
