#include "load/counted_tcp.h"
#include "transport/peer_stream_impl.h"

template class froxel::transport::PeerStream<froxel::load::CountedTcp>;
