#pragma once
// Memory of a device, and copies to and from it.
//
// A device is a card, or its emulation on the processor: memory in pages of its own, which the host can neither read
// nor write while nothing is copied and no kernel runs, as an index too far, a missing copy or a pointer of the wrong
// side would have it. So the tests of a build without a card find them (device/emulated_device.hpp).
#include <cassert>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/simd.hpp"

namespace railstrata::device {

class EmulatedDevice;

/// Launches that are started together, with the arguments that they had when they were recorded.
class Recording {
 public:
  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  virtual ~Recording() = default;
  virtual void start() = 0;
};

class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  /// Zero. Throws EnvironmentError where there is not so much.
  virtual void* allocate(std::size_t bytes) = 0;
  virtual void release(void* memory, std::size_t bytes) = 0;
  // Copies wait for what was launched before, and are done when they return.
  virtual void upload(void* to, const void* from, std::size_t bytes) = 0;
  virtual void download(void* to, const void* from, std::size_t bytes) = 0;
  /// Waits for everything that was launched; throws EnvironmentError if some of it failed.
  virtual void finish() = 0;
  /// Records the kernels that `launches` launches; it launches the same ones in every call and does nothing else. It
  /// may be called now or with every start.
  virtual std::unique_ptr<Recording> record(const std::function<void()>& launches) = 0;
  /// Null for a card.
  virtual EmulatedDevice* emulated() { return nullptr; }
};

/// An array as a kernel sees it. Made from arrays of a device alone, so that no kernel has a pointer of the host.
template <class T>
class View {
 public:
  View() = default;
  template <class U>
  requires(std::is_same_v<const U, T>) RAILSTRATA_POINTWISE View(const View<U>& other)  // NOLINT: reading is a part
      : data_(other.data_), size_(other.size_) {}
  RAILSTRATA_POINTWISE T& operator[](std::ptrdiff_t i) const {
    assert(i >= 0 && i < size_);
    return data_[i];
  }
  RAILSTRATA_POINTWISE std::ptrdiff_t size() const { return size_; }
  View part(std::ptrdiff_t first, std::ptrdiff_t count) const {
    assert(first >= 0 && count >= 0 && first + count <= size_);
    return {data_ + first, count};
  }

 private:
  template <class U>
  friend class DeviceArray;
  template <class U>
  friend class View;
  View(T* data, std::ptrdiff_t size) : data_(data), size_(size) {}
  T* data_ = nullptr;
  std::ptrdiff_t size_ = 0;
};

/// An array in a device's memory, which must live longer.
template <class T>
class DeviceArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  DeviceArray() = default;
  /// Zero everywhere.
  DeviceArray(Device& device, std::size_t size)
      : device_(&device), data_(size ? static_cast<T*>(device.allocate(size * sizeof(T))) : nullptr), size_(size) {}
  DeviceArray(Device& device, std::span<const T> values) : DeviceArray(device, values.size()) { upload(values); }
  DeviceArray(DeviceArray&& other) noexcept { swap(other); }
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    swap(other);
    return *this;
  }
  ~DeviceArray() {
    if (data_) device_->release(data_, bytes());
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  View<T> view() { return {data_, static_cast<std::ptrdiff_t>(size_)}; }
  View<const T> view() const { return {data_, static_cast<std::ptrdiff_t>(size_)}; }

  /// The first values, as many as are given.
  void upload(std::span<const T> values) {
    assert(values.size() <= size_);
    if (!values.empty()) device_->upload(data_, values.data(), values.size_bytes());
  }
  void download(std::span<T> values) const {
    assert(values.size() <= size_);
    if (!values.empty()) device_->download(values.data(), data_, values.size_bytes());
  }
  /// `values.size()` values from `first` on.
  void download(std::size_t first, std::span<T> values) const {
    assert(first + values.size() <= size_);
    if (!values.empty()) device_->download(values.data(), data_ + first, values.size_bytes());
  }
  std::vector<T> values() const {
    std::vector<T> out(size_);
    download(out);
    return out;
  }

 private:
  void swap(DeviceArray& other) {
    std::swap(device_, other.device_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  Device* device_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// The numbers of a container in a device's memory.
template <class T, class Container>
DeviceArray<T> on_device(Device& device, const Container& values) {
  return {device, std::span<const T>(values.data(), values.size())};
}
template <class T>
DeviceArray<T> on_device(Device& device, const std::vector<T>& values) {
  return on_device<T, std::vector<T>>(device, values);
}

}  // namespace railstrata::device
