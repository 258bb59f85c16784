#pragma once
/// \file
/// What every room stands on: ids, errors, threads, progress.

#include <pavior/core/error.hpp>         // what a caller did wrong, and to which entities
#include <pavior/core/execution.hpp>     // how many threads an algorithm may use
#include <pavior/core/index.hpp>         // ids of nodes and cells, and ranges over them
#include <pavior/core/parallel_for.hpp>  // loops over pieces of a range, one piece a thread
#include <pavior/core/progress.hpp>      // a sink for progress
#include <pavior/core/stop.hpp>          // how a call is told to stop
