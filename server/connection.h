// The TCP connection behind a request, for what httplib does not do: see that the client has left,
// let it read an answer although its body was not read, end idle connections.
//
// Handlers are given addresses, not the socket, so the socket is found among the process's
// descriptors by the addresses of its two ends. It stays open, and the number stays its own, for
// as long as the handler or the logger of its request runs: httplib closes it afterwards.
//
// Limits: to the server's side a client that closed and one that only closed its sending half
// (shutdown(SHUT_WR), nc -N) look the same until something is written. Both count as gone: curl
// and browsers close, and a render that nobody waits for is what costs.
#pragma once

#include <httplib.h>

#include <cstddef>

namespace raytracer {

/// How many connections are served at a time, each of which takes a descriptor; more wait for one
/// of them to end.
std::size_t most_connections();

/// The descriptor of the request's connection, or -1 if this process has none such any more.
int find_socket(const httplib::Request& request);

/// Ends both sides of every connection of this process that came in at `local_port`: whoever reads
/// from one sees its end. Only for when no handler runs any more.
void shut_down_connections(int local_port);

/// Whether the client has ended its side; never waits. False for a descriptor of -1.
bool client_has_disconnected(int socket);

/// Ends the sending side, so that the client sees the answer's end, and throws away what it still
/// sends: closing with unread input makes the kernel discard the answer on its way (RST).
/// Returns when the client has closed, was silent for a second, or after five.
void linger(int socket);

}  // namespace raytracer
