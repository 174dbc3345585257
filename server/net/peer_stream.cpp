#include "net/http_site.h"
#include "transport/peer_stream_impl.h"

template class froxel::transport::PeerStream<froxel::net::PacedTcp>;
