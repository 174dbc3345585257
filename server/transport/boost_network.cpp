// Boost's sockets, TLS, HTTP and WebSocket, compiled here instead of in each file that includes
// them; froxel_transport's definitions turn their header-only form off.
#include <boost/asio/impl/src.hpp>
#include <boost/asio/ssl/impl/src.hpp>
#include <boost/beast/src.hpp>
