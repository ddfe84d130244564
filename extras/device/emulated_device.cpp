#include "device/emulated_device.hpp"

#include <cstring>

#include "core/faults.hpp"
#include "device/pages.hpp"

namespace railstrata::device {
namespace {

std::size_t whole_pages(std::size_t bytes) { return (bytes + page_size() - 1) / page_size() * page_size(); }

// The array ends where its last page does, as far as its alignment lets it.
constexpr std::size_t kAlignment = 16;
std::size_t lead(std::size_t bytes) { return (whole_pages(bytes) - bytes) / kAlignment * kAlignment; }

}  // namespace

void* EmulatedDevice::allocate(std::size_t bytes) {
  const std::size_t size = whole_pages(bytes);
  void* const first = closed_pages(size + page_size());
  if (first == nullptr) throw EnvironmentError("no memory for an emulated device");
  if (protection_ == Protection::open) protect_pages(first, size, true);
  arrays_.emplace(first, size);
  allocated_ += bytes;
  return static_cast<char*>(first) + lead(bytes);
}

void EmulatedDevice::release(void* memory, std::size_t bytes) {
  void* const first = static_cast<char*>(memory) - lead(bytes);
  release_pages(first, whole_pages(bytes) + page_size());
  arrays_.erase(first);
  allocated_ -= bytes;
}

void EmulatedDevice::protect(const Pages& pages, bool open) {
  for (const auto& [first, bytes] : pages) protect_pages(first, bytes, open);
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
