// The SPIR-V of every shader, built from this folder; see CMakeLists.txt for file and defines.
#pragma once

#include <cstdint>
#include <span>

namespace froxel::shaders {

std::span<const uint32_t> depth_vert();
std::span<const uint32_t> surface_vert();
std::span<const uint32_t> surface_untextured_vert();
std::span<const uint32_t> surface_extended_vert();
std::span<const uint32_t> depth_masked_frag();
std::span<const uint32_t> depth_masked_extended_frag();
std::span<const uint32_t> gbuffer_frag();
std::span<const uint32_t> gbuffer_extended_frag();
std::span<const uint32_t> gbuffer_extra_frag();
std::span<const uint32_t> gbuffer_extra_extended_frag();
std::span<const uint32_t> forward_frag();
std::span<const uint32_t> forward_extended_frag();
std::span<const uint32_t> forward_batched_frag();
std::span<const uint32_t> forward_batched_extended_frag();
std::span<const uint32_t> forward_weighted_frag();
std::span<const uint32_t> forward_weighted_extended_frag();
std::span<const uint32_t> forward_weighted_batched_frag();
std::span<const uint32_t> forward_weighted_batched_extended_frag();
std::span<const uint32_t> forward_peeled_frag();
std::span<const uint32_t> forward_peeled_extended_frag();
std::span<const uint32_t> forward_peeled_batched_frag();
std::span<const uint32_t> forward_peeled_batched_extended_frag();
std::span<const uint32_t> peel_select_frag();
std::span<const uint32_t> peel_count_frag();
std::span<const uint32_t> blend_resolve_peeled_frag();
std::span<const uint32_t> blend_resolve_weighted_frag();
std::span<const uint32_t> fullscreen_vert();
std::span<const uint32_t> lighting_frag();
std::span<const uint32_t> lighting_batched_frag();
std::span<const uint32_t> lighting_comp();
std::span<const uint32_t> lighting_batched_comp();
std::span<const uint32_t> toon_comp();
std::span<const uint32_t> outline_comp();
std::span<const uint32_t> tonemap_comp();
std::span<const uint32_t> fxaa_comp();
std::span<const uint32_t> bloom_bright_comp();
std::span<const uint32_t> bloom_single_comp();
std::span<const uint32_t> bloom_line_comp();
std::span<const uint32_t> bloom_a_trous_comp();
std::span<const uint32_t> bloom_down_comp();
std::span<const uint32_t> bloom_up_comp();
std::span<const uint32_t> fog_comp();
std::span<const uint32_t> fog_scatter_comp();
std::span<const uint32_t> fog_integrate_comp();
std::span<const uint32_t> count_pairs_comp();
std::span<const uint32_t> debug_view_comp();
std::span<const uint32_t> overdraw_frag();
std::span<const uint32_t> overdraw_masked_frag();
std::span<const uint32_t> overdraw_masked_extended_frag();
std::span<const uint32_t> light_wires_vert();
std::span<const uint32_t> cluster_wires_vert();
std::span<const uint32_t> wire_frag();
std::span<const uint32_t> cull_meshlets_comp();
std::span<const uint32_t> cull_list_comp();
std::span<const uint32_t> cull_compact_comp();
std::span<const uint32_t> visibility_vert();
std::span<const uint32_t> visibility_frag();
std::span<const uint32_t> visibility_masked_vert();
std::span<const uint32_t> visibility_masked_frag();
std::span<const uint32_t> visibility_masked_extended_vert();
std::span<const uint32_t> visibility_masked_extended_frag();
std::span<const uint32_t> visibility_gbuffer_comp();
std::span<const uint32_t> visibility_gbuffer_bindless_comp();
std::span<const uint32_t> visibility_shade_comp();
std::span<const uint32_t> visibility_shade_bindless_comp();
std::span<const uint32_t> visibility_shade_batched_comp();
std::span<const uint32_t> visibility_shade_batched_bindless_comp();
std::span<const uint32_t> raster_meshlets_comp();
std::span<const uint32_t> raster_meshlets_bindless_comp();
std::span<const uint32_t> raster_blocks_comp();
std::span<const uint32_t> raster_blocks_bindless_comp();
std::span<const uint32_t> raster_unpack_comp();
std::span<const uint32_t> assign_bound_comp();
std::span<const uint32_t> assign_count_comp();
std::span<const uint32_t> assign_sum_comp();
std::span<const uint32_t> assign_place_comp();
std::span<const uint32_t> assign_fill_comp();
std::span<const uint32_t> assign_order_comp();
std::span<const uint32_t> assign_order_long_comp();
std::span<const uint32_t> assign_probe_comp();

// Every one of them, for what must know whether any has changed.
std::span<const std::span<const uint32_t>> all();

} // namespace froxel::shaders
