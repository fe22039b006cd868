#pragma once
// The dialogs for exports, pictures and turntables: their actions and their results.

namespace clay::studio {

struct AppState;

/// Opens the dialog with a name and a folder for the pot.
void show_export(AppState& state);
/// Starts the export. Asks first if files stand in its place, unless `replace` is set.
void write_export(AppState& state, bool replace);

/// Opens the dialog for a picture of the pot as the view shows it: direction, surface, cut, map.
void show_picture(AppState& state, bool turntable);
/// Starts to draw and write. Asks first as `write_export` does.
void write_picture(AppState& state, bool replace);

/// Shows the folder of the files that the open dialog has written in the file manager.
void show_written_folder(AppState& state);

// --- Once a frame. -------------------------------------------------------------------------------
/// Takes the files or the preview of an export. While the dialog is open, an export is previewed
/// after every change of the choices or, by an arm, of the pot.
void update_export(AppState& state);
void update_picture(AppState& state);

}  // namespace clay::studio
