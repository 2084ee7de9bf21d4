// Loaded into the program with LD_PRELOAD: makes its file operations fail or kills it in the middle of one.
//   VEHD_FAULT="kill N"      SIGKILL at the N-th operation; a write has written half of its bytes by then
//   VEHD_FAULT="full N"      the disk has room for N more bytes
//   VEHD_FAULT="readonly N"  the file system becomes read-only at the N-th operation
//   VEHD_FAULT="unlocked N"  no file can be locked: flock() fails with the error number N
//   VEHD_FAULT="count FILE"  no fault; writes the number of operations and of bytes to FILE at the end
// Operations are those on regular files: writing, creating, renaming, linking and removing.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

class Fault {
 public:
  Fault() {
    const char* text = std::getenv("VEHD_FAULT");
    const std::string fault = text == nullptr ? "" : text;
    const std::size_t space = fault.find(' ');
    if (space == std::string::npos) return;
    kind_ = fault.substr(0, space);
    argument_ = fault.substr(space + 1);
    if (kind_ != "count") limit_ = std::stoll(argument_);
  }

  ~Fault() {
    if (kind_ != "count") return;
    if (FILE* file = std::fopen(argument_.c_str(), "w")) {
      std::fprintf(file, "%lld %lld\n", operations_, bytes_);
      std::fclose(file);
    }
  }

  bool admits_locks() const {
    if (kind_ != "unlocked") return true;
    errno = static_cast<int>(limit_);
    return false;
  }

  /// Whether an operation without data may go on.
  bool admits() {
    ++operations_;
    if (killed()) ::kill(::getpid(), SIGKILL);
    if (kind_ != "readonly" || operations_ < limit_) return true;
    errno = EROFS;
    return false;
  }

  /// Number of bytes that may be written; -1: none, with errno set.
  ssize_t admits(size_t bytes) {
    ++operations_;
    bytes_ += static_cast<long long>(bytes);
    if (killed()) return static_cast<ssize_t>(bytes / 2);
    if (kind_ == "readonly" && operations_ >= limit_) {
      errno = EROFS;
      return -1;
    }
    if (kind_ != "full") return static_cast<ssize_t>(bytes);
    const auto room = std::min(static_cast<long long>(bytes), limit_);
    if (room == 0 && bytes > 0) {
      errno = ENOSPC;
      return -1;
    }
    limit_ -= room;
    return static_cast<ssize_t>(room);
  }

  /// Called after the admitted bytes have been written.
  ssize_t written(ssize_t result) const {
    if (killed()) ::kill(::getpid(), SIGKILL);
    return result;
  }

 private:
  [[nodiscard]] bool killed() const { return kind_ == "kill" && operations_ == limit_; }

  std::string kind_, argument_;
  long long limit_ = 0, operations_ = 0, bytes_ = 0;
};

Fault& fault() {
  static Fault instance;
  return instance;
}

bool is_file(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

template <typename Write>
ssize_t write_part(int descriptor, size_t bytes, Write write) {
  if (!is_file(descriptor)) return write(bytes);
  const ssize_t admitted = fault().admits(bytes);
  return admitted < 0 ? -1 : fault().written(write(static_cast<size_t>(admitted)));
}

template <typename... Arguments>
int change(const char* name, Arguments... arguments) {
  if (!fault().admits()) return -1;
  return real<int (*)(Arguments...)>(name)(arguments...);
}

template <typename... Arguments>
int open_file(const char* name, int flags, mode_t mode, Arguments... arguments) {
  const bool writes = (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
  if (writes && !fault().admits()) return -1;
  return real<int (*)(Arguments..., int, ...)>(name)(arguments..., flags, mode);
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, size_t bytes) {
  return write_part(descriptor, bytes, [&](size_t part) {
    return real<ssize_t (*)(int, const void*, size_t)>("write")(descriptor, data, part);
  });
}

ssize_t pwrite(int descriptor, const void* data, size_t bytes, off_t offset) {
  return write_part(descriptor, bytes, [&](size_t part) {
    return real<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite")(descriptor, data, part, offset);
  });
}

ssize_t pwrite64(int descriptor, const void* data, size_t bytes, off64_t offset) {
  return pwrite(descriptor, data, bytes, offset);
}

ssize_t writev(int descriptor, const iovec* parts, int count) {
  ssize_t total = 0;
  for (int i = 0; i < count; ++i) {
    const ssize_t result = write(descriptor, parts[i].iov_base, parts[i].iov_len);
    if (result < 0) return total > 0 ? total : -1;
    total += result;
    if (static_cast<size_t>(result) < parts[i].iov_len) break;
  }
  return total;
}

ssize_t sendfile(int to, int from, off_t* offset, size_t bytes) {
  return write_part(to, bytes, [&](size_t part) {
    return real<ssize_t (*)(int, int, off_t*, size_t)>("sendfile")(to, from, offset, part);
  });
}

ssize_t sendfile64(int to, int from, off64_t* offset, size_t bytes) { return sendfile(to, from, offset, bytes); }

ssize_t copy_file_range(int from, off64_t* from_offset, int to, off64_t* to_offset, size_t bytes, unsigned flags) {
  return write_part(to, bytes, [&](size_t part) {
    return real<ssize_t (*)(int, off64_t*, int, off64_t*, size_t, unsigned)>("copy_file_range")(from, from_offset, to,
                                                                                                to_offset, part, flags);
  });
}

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_file("open", flags, mode, path);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_file("open64", flags, mode, path);
}

int openat(int directory, const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_file("openat", flags, mode, directory, path);
}

int ftruncate(int descriptor, off_t size) { return change("ftruncate", descriptor, size); }
int ftruncate64(int descriptor, off64_t size) { return change("ftruncate64", descriptor, size); }
int truncate(const char* path, off_t size) { return change("truncate", path, size); }
int rename(const char* from, const char* to) { return change("rename", from, to); }
int link(const char* from, const char* to) { return change("link", from, to); }
int unlink(const char* path) { return change("unlink", path); }
int remove(const char* path) { return change("remove", path); }
int mkdir(const char* path, mode_t mode) { return change("mkdir", path, mode); }

int flock(int descriptor, int operation) {
  return fault().admits_locks() ? real<int (*)(int, int)>("flock")(descriptor, operation) : -1;
}

}  // extern "C"
