#include "app/program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <utility>

namespace railstrata {
namespace {

/// A launcher may have closed them, and the next file opened would get their number: a table would get the messages.
/// Output that is not there stays an error.
void occupy_standard_streams() {
  for (const auto& [stream, flags] :
       {std::pair{STDIN_FILENO, O_RDONLY}, std::pair{STDOUT_FILENO, O_RDONLY}, std::pair{STDERR_FILENO, O_WRONLY}})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", flags));  // takes the lowest number that is free
}

}  // namespace

void settle_in() {
  occupy_standard_streams();
  std::signal(SIGUSR1, SIG_IGN);  // a request for a checkpoint where none can be made
  for (const int limit : {SIGXFSZ, SIGPIPE})
    std::signal(limit, SIG_IGN);  // a limit on file sizes, a reader that is gone: errors of the write, with a message
}

}  // namespace railstrata
