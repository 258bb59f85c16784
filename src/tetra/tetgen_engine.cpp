#include "tetgen_engine.hpp"

#include <pavior/core/error.hpp>

#include <tetgen.h>

#include <algorithm>
#include <cstddef>

#include <dlfcn.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PAVIOR_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define PAVIOR_SANITIZED
#endif
#endif

namespace pavior::detail {

namespace {

int as_int(Index id) { return static_cast<int>(id); }

/// The arrays of a tetgenio are freed by it with delete[].
void fill_nodes(const Plc& plc, tetgenio& in) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(plc.nodes.size());
    in.pointlist = new REAL[3 * plc.nodes.size()];
    for (std::size_t i = 0; i < plc.nodes.size(); ++i) {
        std::copy(plc.nodes[i].data(), plc.nodes[i].data() + 3, in.pointlist + 3 * i);
    }
    in.numberofholes = static_cast<int>(plc.holes.size());
    if (!plc.holes.empty()) {
        in.holelist = new REAL[3 * plc.holes.size()];
        for (std::size_t i = 0; i < plc.holes.size(); ++i) {
            std::copy(plc.holes[i].data(), plc.holes[i].data() + 3, in.holelist + 3 * i);
        }
    }
}

void fill_facets(const Plc& plc, tetgenio& in) {
    in.numberoffacets = static_cast<int>(plc.facets.size());
    in.facetlist = new tetgenio::facet[plc.facets.size()];
    in.facetmarkerlist = new int[plc.facets.size()];
    for (std::size_t i = 0; i < plc.facets.size(); ++i) {
        tetgenio::facet& facet = in.facetlist[i];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        facet.polygonlist[0].numberofvertices = 3;
        facet.polygonlist[0].vertexlist = new int[3];
        std::transform(plc.facets[i].begin(), plc.facets[i].end(), facet.polygonlist[0].vertexlist, as_int);
        in.facetmarkerlist[i] = plc.facet_numbers[i];
    }
}

void fill_edges(const Plc& plc, tetgenio& in) {
    in.numberofedges = static_cast<int>(plc.edges.size());
    if (plc.edges.empty()) {
        return;
    }
    in.edgelist = new int[2 * plc.edges.size()];
    in.edgemarkerlist = new int[plc.edges.size()];
    for (std::size_t i = 0; i < plc.edges.size(); ++i) {
        in.edgelist[2 * i] = as_int(plc.edges[i].nodes[0]);
        in.edgelist[2 * i + 1] = as_int(plc.edges[i].nodes[1]);
        in.edgemarkerlist[i] = plc.edges[i].tag;
    }
}

template <class T>
std::vector<T> copy(const T* from, int count, int width) {
    return from == nullptr ? std::vector<T>{} : std::vector<T>(from, from + std::ptrdiff_t{count} * width);
}

const char* meaning(int code) {
    switch (code) {
        case 1: return "out of memory";
        case 2: return "TetGen met an internal error";
        case 3: return "TetGen met a self-intersection";
        case 4: return "TetGen met a very small feature";
        case 5: return "TetGen met two facets very close to each other";
        default: return "TetGen refused the input";
    }
}

using Tetrahedralize = void (*)(char*, tetgenio*, tetgenio*, tetgenio*, tetgenio*);

/// Gmsh brings a TetGen of its own, whose symbols would stand in for those of the library wherever both are linked. So
/// the library is loaded by hand, and looks for symbols in itself first. Sanitizers forbid that: they get a copy of it
/// in a namespace of its own, out of which no exception comes.
Tetrahedralize load_tetgen() {
    for (const char* name : {PAVIOR_TETGEN_SONAME, PAVIOR_TETGEN_LIBRARY}) {
#ifdef PAVIOR_SANITIZED
        void* library = dlmopen(LM_ID_NEWLM, name, RTLD_NOW);
#else
        void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
#endif
        if (library != nullptr) {
            if (void* found = dlsym(library, "_Z14tetrahedralizePcP8tetgenioS1_S1_S1_"); found != nullptr) {
                return reinterpret_cast<Tetrahedralize>(found);
            }
        }
    }
    const char* why = dlerror();
    throw Error(ErrorCode::tetrahedra_failed,
                "the library TetGen cannot be loaded: " + std::string(why != nullptr ? why : "no reason given"));
}

Tetrahedralize tetgen() {
    static const Tetrahedralize loaded = load_tetgen();
    return loaded;
}

}  // namespace

void prepare_tetgen() { static_cast<void>(tetgen()); }

RawTets run_tetgen(const Plc& plc, const std::string& switches) {
    const Tetrahedralize tetrahedralize = tetgen();
    tetgenio in;
    tetgenio& out = *new tetgenio;  // its arrays belong to the library, and go with the process
    fill_nodes(plc, in);
    fill_facets(plc, in);
    fill_edges(plc, in);
    std::vector<char> text(switches.begin(), switches.end());
    text.push_back('\0');
    try {
        tetrahedralize(text.data(), &in, &out, nullptr, nullptr);
    } catch (int code) {
        throw Error(ErrorCode::tetrahedra_failed, meaning(code));
    }
    RawTets raw;
    raw.nodes = copy(out.pointlist, out.numberofpoints, 3);
    raw.tets = copy(out.tetrahedronlist, out.numberoftetrahedra, out.numberofcorners);
    raw.facets = copy(out.trifacelist, out.numberoftrifaces, 3);
    raw.facet_numbers = copy(out.trifacemarkerlist, out.numberoftrifaces, 1);
    raw.edges = copy(out.edgelist, out.numberofedges, 2);
    raw.edge_numbers = copy(out.edgemarkerlist, out.numberofedges, 1);
    return raw;
}

}  // namespace pavior::detail
