// Every kernel of the op table.
#pragma once

#include "frep/field/kernels/basic.h"
#include "frep/field/kernels/blend.h"
#include "frep/field/kernels/convolution.h"
#include "frep/field/kernels/distance.h"
#include "frep/field/kernels/freeform.h"
#include "frep/field/kernels/noise.h"
#include "frep/field/kernels/outline.h"
#include "frep/field/kernels/radial.h"
#include "frep/field/kernels/rsystems.h"
#include "frep/field/kernels/skeleton.h"
