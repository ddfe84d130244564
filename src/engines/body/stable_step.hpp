#pragma once
// The largest step central differences can take on a body.
#include "body/local_steps.hpp"
#include "body/mass_scaling.hpp"

namespace railstrata {

/// 2/omega_max of K u = omega^2 (M + A) u on the free degrees of freedom, slaves following their masters, by Lanczos
/// steps [s]. Ritz values approach omega_max from below: the step is found from above, 60 iterations leave less than 1
/// %.
double lanczos_stable_step(const Body& body, const MassScaling& scaling = {}, int iterations = 60);

/// The same for the nodes that local steps leave coarse, their fine nodes fixed: the longest step these can hope for.
double lanczos_coarse_step(const Body& body, const LocalSteps& local, int iterations = 60);

/// Ends of the spectrum of D^2 B K (body/local_steps.hpp): stable if it lies above zero and below four.
struct StepSpectrum {
  double least = 0, largest = 0;
};
StepSpectrum lanczos_spectrum(const Body& body, LocalSteps& local, int iterations = 60);

}  // namespace railstrata
