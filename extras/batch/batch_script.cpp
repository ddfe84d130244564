#include "batch/batch_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "record/escaped_text.hpp"

namespace railstrata {
namespace {

constexpr double kTimeMargin = 3, kLeastTime = 900;          // s; the estimate leaves out the preload
constexpr double kMemoryMargin = 1.5, kLeastMemory = 512e6;  // bytes

std::string slurm_time(double seconds) {
  const auto minutes = static_cast<long>(std::ceil(std::max(kLeastTime, kTimeMargin * seconds) / 60));
  return fmt::format("{:02}:{:02}:00", minutes / 60, minutes % 60);
}

}  // namespace

std::string index_ranges(const std::vector<int>& indices) {
  std::string out;
  for (std::size_t k = 0; k < indices.size();) {
    std::size_t last = k;
    while (last + 1 < indices.size() && indices[last + 1] == indices[last] + 1) ++last;
    out += out.empty() ? "" : ",";
    out += last == k ? fmt::format("{}", indices[k]) : fmt::format("{}-{}", indices[k], indices[last]);
    k = last + 1;
  }
  return out;
}

std::string slurm_script(const BatchJob& job) {
  std::vector<int> tasks = job.finite_elements;
  if (job.half_spaces) tasks.insert(tasks.begin(), 0);
  const double memory = std::max(kLeastMemory, kMemoryMargin * job.most.memory_bytes);
  std::string call =
      fmt::format("{} study {} --out {}", shell_word(job.program), shell_word(job.study), shell_word(job.out));
  for (const std::string& o : job.options) call += fmt::format(" {}", shell_word(o));
  return fmt::format(R"sh(#!/bin/sh
#SBATCH --job-name=railstrata
#SBATCH --array={}
#SBATCH --cpus-per-task={}
#SBATCH --mem={}M
#SBATCH --time={}
#SBATCH --signal=B:TERM@60
#SBATCH --requeue
#SBATCH --open-mode=append
# Task 0: all cases by half-spaces. Task n: the n-th case of the study.
if [ "$SLURM_ARRAY_TASK_ID" = 0 ]; then part="--engine bem"; else part="--only $SLURM_ARRAY_TASK_ID"; fi
{} $part --threads "$SLURM_CPUS_PER_TASK" --no-report --quiet &
study=$!
# a minute before the end: it stops in good order, with a checkpoint
trap 'signalled=yes; kill -TERM $study' TERM
trap 'signalled=yes; kill -USR1 $study' USR1  # scancel --signal=USR1 --batch: a checkpoint now
signalled=yes
while [ $signalled = yes ]; do  # a signal ends the wait, not the study
  signalled=no
  wait $study
  ended=$?
  [ $ended = 127 ] || code=$ended  # 127: it had ended before
done
# By its number in the array: for its last task SLURM_JOB_ID names all of them. Not after scancel: it runs no more.
task=${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID
case $code in
  130|5) [ -z "$(squeue --noheader --states=RUNNING --jobs="$task")" ] || scontrol requeue "$task" ;;
esac
exit $code
)sh",
                     index_ranges(tasks), job.threads, static_cast<long>(std::ceil(1e-6 * memory)),
                     slurm_time(job.most.seconds), call);
}

}  // namespace railstrata
