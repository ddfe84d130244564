#include "device/emulated_device.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstring>

#include "core/faults.hpp"

namespace railstrata::device {
namespace {

std::size_t page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}
std::size_t whole_pages(std::size_t bytes) { return (bytes + page_size() - 1) / page_size() * page_size(); }

// The array ends where its last page does, as far as its alignment lets it.
constexpr std::size_t kAlignment = 16;
std::size_t lead(std::size_t bytes) { return (whole_pages(bytes) - bytes) / kAlignment * kAlignment; }

}  // namespace

void* EmulatedDevice::allocate(std::size_t bytes) {
  const std::size_t size = whole_pages(bytes);
  void* const first = mmap(nullptr, size + page_size(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (first == MAP_FAILED) throw EnvironmentError("no memory for an emulated device");
  if (protection_ == Protection::open) mprotect(first, size, PROT_READ | PROT_WRITE);
  arrays_.emplace(first, size);
  allocated_ += bytes;
  return static_cast<char*>(first) + lead(bytes);
}

void EmulatedDevice::release(void* memory, std::size_t bytes) {
  void* const first = static_cast<char*>(memory) - lead(bytes);
  munmap(first, whole_pages(bytes) + page_size());
  arrays_.erase(first);
  allocated_ -= bytes;
}

void EmulatedDevice::protect(const Pages& pages, bool open) {
  for (const auto& [first, bytes] : pages) mprotect(first, bytes, open ? PROT_READ | PROT_WRITE : PROT_NONE);
}

void EmulatedDevice::open_device(bool open) {
  if (protection_ == Protection::closed) protect(arrays_, open);
}

void EmulatedDevice::upload(void* to, const void* from, std::size_t bytes) { copy(to, from, bytes, to); }

void EmulatedDevice::download(void* to, const void* from, std::size_t bytes) { copy(to, from, bytes, from); }

namespace {

class Repeated : public Recording {
 public:
  explicit Repeated(std::function<void()> launches) : launches_(std::move(launches)) {}
  void start() override { launches_(); }

 private:
  std::function<void()> launches_;
};

}  // namespace

std::unique_ptr<Recording> EmulatedDevice::record(const std::function<void()>& launches) {
  return std::make_unique<Repeated>(launches);
}

// Opens the pages of one array alone; a copy beyond them faults.
void EmulatedDevice::copy(void* to, const void* from, std::size_t bytes, const void* array) {
  ++copies_;
  const auto own = std::prev(arrays_.upper_bound(const_cast<void*>(array)));
  const Pages pages{*own};
  if (protection_ == Protection::closed) protect(pages, true);
  std::memcpy(to, from, bytes);
  if (protection_ == Protection::closed) protect(pages, false);
}

}  // namespace railstrata::device
