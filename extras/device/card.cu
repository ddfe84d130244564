// The card. Only what CUDA's compiler must see stands here: the kernels and the runtime's calls.
#include <cuda_runtime.h>

#include <cstdio>

#include "core/faults.hpp"
#include "device/card.hpp"
#include "device/kernel_list.hpp"

namespace railstrata::device {
namespace {

constexpr int kThreads = 128;  // in a block; results do not depend on it

void require(cudaError_t code, const char* what) {
  if (code == cudaSuccess) return;
  throw EnvironmentError(std::string("the card: ") + what + ": " + cudaGetErrorString(code),
                         "run.device = \"cpu\" computes without it");
}

cudaStream_t stream = nullptr;  // of all launches and copies: one after the other

// A graph of launches.
class Graph : public Recording {
 public:
  explicit Graph(const std::function<void()>& launches) {
    cudaGraph_t graph{};
    require(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal), "launches cannot be recorded");
    launches();
    require(cudaStreamEndCapture(stream, &graph), "launches cannot be recorded");
    const cudaError_t made = cudaGraphInstantiate(&launched_, graph, 0);
    cudaGraphDestroy(graph);
    require(made, "a recording cannot be made ready");
  }
  ~Graph() override { cudaGraphExecDestroy(launched_); }
  void start() override { require(cudaGraphLaunch(launched_, stream), "a recording was not started"); }

 private:
  cudaGraphExec_t launched_ = nullptr;
};

class Card : public Device {
 public:
  Card() {
    require(cudaSetDevice(0), "it cannot be opened");
    if (!stream) require(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "it cannot be opened");
  }
  void* allocate(std::size_t bytes) override {
    void* p = nullptr;
    require(cudaMalloc(&p, bytes), "not enough memory");
    require(cudaMemsetAsync(p, 0, bytes, stream), "memory cannot be cleared");
    return p;
  }
  void release(void* memory, std::size_t) override { cudaFree(memory); }
  void upload(void* to, const void* from, std::size_t bytes) override {
    require(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream), "a copy to it failed");
    finish();
  }
  void download(void* to, const void* from, std::size_t bytes) override {
    require(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream), "a copy from it failed");
    finish();
  }
  void finish() override { require(cudaStreamSynchronize(stream), "a kernel or a copy failed"); }
  std::unique_ptr<Recording> record(const std::function<void()>& launches) override {
    return std::make_unique<Graph>(launches);
  }
};

template <class Kernel>
__global__ void run(std::ptrdiff_t n, const __grid_constant__ Kernel kernel) {
  const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i < n) kernel(i);
}

constexpr int kGroup = 256;  // threads of a group; results do not depend on it

struct CardGroup {
  template <class Work>
  RAILSTRATA_POINTWISE void each(std::ptrdiff_t n, const Work& work) const {
#ifdef __CUDA_ARCH__
    for (std::ptrdiff_t i = threadIdx.x; i < n; i += kGroup) work(i);
    __syncthreads();
#endif
  }
  template <class Work>
  RAILSTRATA_POINTWISE void once(const Work& work) const {
    each(1, [&](std::ptrdiff_t) { work(); });
  }
};

template <class Kernel>
__global__ void __launch_bounds__(kGroup) run_group(const __grid_constant__ Kernel kernel) {
  kernel(CardGroup{});
}

struct CopyNumbers {
  const double* from;
  double* to;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const { to[i] = from[i]; }
};

}  // namespace

template <class Kernel>
void launch_on_card(std::ptrdiff_t n, const Kernel& kernel) {
  run<<<static_cast<unsigned>((n + kThreads - 1) / kThreads), kThreads, 0, stream>>>(n, kernel);
  require(cudaGetLastError(), "a kernel was not launched");
}

template <class Kernel>
void launch_group_on_card(const Kernel& kernel) {
  run_group<<<1, kGroup, 0, stream>>>(kernel);
  require(cudaGetLastError(), "a kernel was not launched");
}

#define RAILSTRATA_INSTANTIATE_GROUP(...) template void launch_group_on_card(const __VA_ARGS__&);
RAILSTRATA_EVERY_GROUP_KERNEL(RAILSTRATA_INSTANTIATE_GROUP)
#define RAILSTRATA_INSTANTIATE(...) template void launch_on_card(std::ptrdiff_t, const __VA_ARGS__&);
RAILSTRATA_EVERY_KERNEL(RAILSTRATA_INSTANTIATE)

bool built_for_cards() { return true; }

void require_card() {
  int cards = 0;
  const cudaError_t code = cudaGetDeviceCount(&cards);
  if (code == cudaSuccess && cards > 0) return;
  const char* const why = code == cudaSuccess                   ? "none is there"
                          : code == cudaErrorInsufficientDriver ? "no NVIDIA driver, or one too old for this program"
                                                                : cudaGetErrorString(code);
  throw EnvironmentError(std::string("no card was found (") + why + ")",
                         "run.device = \"cpu\", or a machine with an NVIDIA card and its driver (nvidia-smi lists it)");
}

std::unique_ptr<Device> open_card() {
  require_card();
  return std::make_unique<Card>();
}

std::string card_name() {
  int cards = 0, runtime = 0, driver = 0;
  if (cudaGetDeviceCount(&cards) != cudaSuccess || cards == 0) return {};
  cudaDeviceProp p{};
  if (cudaGetDeviceProperties(&p, 0) != cudaSuccess) return {};
  cudaRuntimeGetVersion(&runtime);
  cudaDriverGetVersion(&driver);
  char text[512];
  std::snprintf(text, sizeof text, "%s; compute capability %d.%d; %.1f GiB; driver %d.%d; runtime %d.%d", p.name,
                p.major, p.minor, static_cast<double>(p.totalGlobalMem) / (1 << 30), driver / 1000, driver % 1000 / 10,
                runtime / 1000, runtime % 1000 / 10);
  return text;
}

double card_copy_rate() {
  constexpr std::ptrdiff_t kNumbers = std::ptrdiff_t{1} << 27;  // 1 GiB
  constexpr int kTimes = 20;
  const auto card = open_card();
  const DeviceArray<double> from(*card, kNumbers);
  DeviceArray<double> to(*card, kNumbers);
  const CopyNumbers kernel{&from.view()[0], &to.view()[0]};
  cudaEvent_t begin{}, end{};
  require(cudaEventCreate(&begin), "no event");
  require(cudaEventCreate(&end), "no event");
  for (int k = -2; k < kTimes; ++k) {  // two to warm up
    if (k == 0) require(cudaEventRecord(begin, stream), "no event");
    launch_on_card(kNumbers, kernel);
  }
  require(cudaEventRecord(end, stream), "no event");
  require(cudaEventSynchronize(end), "a copy failed");
  float ms = 0;
  require(cudaEventElapsedTime(&ms, begin, end), "no time");
  return 2.0 * sizeof(double) * kNumbers * kTimes / (1e-3 * ms);
}

}  // namespace railstrata::device
