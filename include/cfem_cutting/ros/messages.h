#pragma once
/// The package's messages and services. Catkin puts them into the namespace named after the package, where
/// the core has a FractureEvent and a StepReport of its own; so here the messages of these names are called
/// …Message. Include this, not the generated headers, where the core's reports are used too.

#include <cfem_cutting/ContactForces.h>
#include <cfem_cutting/SurfaceMesh.h>

#define FractureEvent FractureEventMessage
#define StepReport StepReportMessage
#include <cfem_cutting/FractureEvent.h>
#include <cfem_cutting/StepReport.h>
#undef FractureEvent
#undef StepReport

#include <cfem_cutting/GetEvents.h>
#include <cfem_cutting/SaveSurface.h>
