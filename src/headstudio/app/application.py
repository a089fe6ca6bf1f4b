"""The application: a studio in its window, frame by frame."""

from __future__ import annotations

import time
from collections.abc import Callable

from imgui_bundle import imgui

from ..scene.stage import Stage
from . import scale_bar, shell, split_line, status, theme, toasts, view_bar
from .actions import Actions
from .commands import run_pressed
from .dialogs import Dialogs
from .editors import EDITORS, Editor, SideView
from .parameter_rows import ParameterRows
from .recorder import Recorder
from .sidebar import Sidebar
from .studio import Studio
from .tools.tool import Tool
from .transport import Transport
from .ui import Rect, Ui
from .viewport import Viewport
from .window import Window

IDLE_WAIT = 0.1  # [s] between two looks for events while nothing moves
MEASURE_EVERY = 0.1  # [s]


class Application:
    """Joins studio and window. ``frame`` does everything once; ``run`` does it until the window is closed."""

    def __init__(self, window: Window, studio: Studio) -> None:
        self.window = window
        self.studio = studio
        self.ui = Ui(theme.apply(window.scale), window.scale)
        self.sizes = shell.Sizes()
        self.recorder = Recorder()
        self.dialogs = Dialogs(native=not window.headless)
        self.rows = ParameterRows(studio)
        self._tools: dict[str, list[Tool]] = {
            editor.label: [make(studio) for make in editor.tools] for editor in EDITORS
        }
        self.editor = EDITORS[0]
        self.viewport = Viewport(studio, window.gl, self.tools[0])
        self._steps = {
            editor.label: editor.steps(self.rows, self.viewport, self._tools[editor.label])
            for editor in EDITORS
            if editor.steps is not None
        }
        self._beside = {editor.label: editor.beside(self.viewport) for editor in EDITORS if editor.beside is not None}
        self._timelines = {
            editor.label: editor.timeline(self.rows) for editor in EDITORS if editor.timeline is not None
        }
        self.actions = Actions(self)
        self.commands = self.actions.commands()
        self.sidebar = Sidebar(self.rows, self.viewport)
        self.transport = Transport(studio, self.recorder, self.actions.record)
        self.closed = False
        self.after_frame: list[Callable[[], object]] = []
        self._measured: Stage | None = None
        self._unmeasured = MEASURE_EVERY
        window.on_drop = self.actions.take_dropped
        self._last = time.perf_counter()

    def run(self) -> None:
        """Go on until the window is closed."""
        while not self.closed:
            self.frame(wait=IDLE_WAIT if self._idle else 0.0)
        if self.recorder.recording:
            self.recorder.stop()

    def frame(self, seconds: float | None = None, wait: float = 0.0) -> None:
        """One frame. ``seconds``: its length for everything that moves, None for the clock on the wall."""
        if self.window.close_asked:
            self.window.keep_open()
            self.actions.quit()
        if self.window.minimised:
            self.window.sleep(IDLE_WAIT)
            return
        self._follow_screen()
        now = time.perf_counter()
        wall, self._last = (now - self._last if seconds is None else seconds), now
        self.window.begin_frame(seconds, wait)
        self.studio.tick(wall, self.recorder.frame_seconds)
        self._draw()
        self._measure(wall)
        self.window.set_title(f"{self.studio.work.name}{' *' if self.studio.work.modified else ''} - headstudio")
        self.window.end_frame(theme.GROUND)
        self._record()
        while self.after_frame:
            self.after_frame.pop(0)()

    @property
    def _idle(self) -> bool:
        """Whether nothing changes until the user does something."""
        studio = self.studio
        return not (studio.playback.playing or studio.building or studio.messages.shown or imgui.is_any_item_active())

    def _follow_screen(self) -> None:
        """The window may have been moved to a screen of another density."""
        if abs(self.window.scale - self.ui.scale) > 0.01:
            theme.rescale(self.ui.scale, self.window.scale)
            self.ui.scale = self.window.scale

    def _draw(self) -> None:
        self.ui.new_frame()
        self._follow_work()
        if not self.dialogs.asking:
            run_pressed(self.commands)
        top = shell.menu_bar(self.ui, self.commands, {"Open...": self.actions.recent_menu})
        layout = shell.lay_out(self.ui, self.sizes, top)
        shell.region("Left", layout.left, self._draw_left, scrolls=True)
        shell.region("View", layout.view, lambda: self._draw_view(layout), plain=True)
        shell.region("Foot", layout.foot, lambda: self.transport.draw(self.ui, self._timelines.get(self.editor.label)))
        shell.region("Right", layout.right, self._draw_right, scrolls=True)
        shell.edges(self.ui, self.sizes, layout)
        shell.region("Status", layout.status, lambda: status.draw(self.ui, self.studio, layout.status), plain=True)
        self.dialogs.draw(self.ui, self.commands)
        self.rows.finish_frame()

    @property
    def tools(self) -> list[Tool]:
        """The tools of the open editor."""
        return self._tools[self.editor.label]

    @property
    def beside(self) -> SideView | None:
        """The other view that the open editor has, shown or not."""
        return self._beside.get(self.editor.label)

    def _draw_left(self) -> None:
        self._draw_tabs()
        self.sidebar.draw(self.ui, self.editor, self.tools)

    def _draw_tabs(self) -> None:
        """The tabs of the editors, side by side over the whole width."""
        gap = self.ui.px(2)
        width = (imgui.get_content_region_avail().x - gap * (len(EDITORS) - 1)) / len(EDITORS)
        with self.ui.within("Editors"):
            for k, editor in enumerate(EDITORS):
                if k:
                    imgui.same_line(0, gap)
                if self.ui.button(editor.label, on=editor is self.editor, width=width):
                    self.open_editor(editor)

    def open_editor(self, editor: Editor) -> None:
        """Open a tab; hair and skin are shown as what the tab is about."""
        if editor is self.editor:
            return
        self.editor = editor
        self.viewport.tool = self.tools[0]
        self.commands = self.actions.commands()
        work = self.studio.work
        work.hair_as, work.skin_as = editor.hair_as or work.hair_as, editor.skin_as or work.skin_as

    def _follow_work(self) -> None:
        """A project that was opened, or a build that was cancelled, may show something else than the open tab is about."""
        work = self.studio.work
        for editor in (self.editor, *EDITORS):
            if editor.is_about(work.hair_as, work.skin_as):
                self.open_editor(editor)
                return

    def _draw_view(self, layout: shell.Layout) -> None:
        view, beside = layout.view, self.beside
        split = beside is not None and beside.shown
        width = round(0.5 * view.width) if split else view.width
        self.viewport.draw(self.ui, (width, view.height), self.window.pixels_per_unit)
        if beside is not None and split:
            beside.draw(self.ui, Rect(view.x + width, view.y, view.width - width, view.height))
        shown = Rect(view.x, view.y, width, view.height)
        view_bar.draw(self.ui, self.viewport, shown, beside)
        if self.editor.skin_as == "living":
            split_line.draw(self.ui, self.rows, shown)
            scale_bar.draw(self.ui, self.studio.document.look.skin_shows, shown)
        status.progress(self.ui, self.studio, view)
        toasts.draw(self.ui, self.studio.messages, view)

    def _draw_right(self) -> None:
        self.rows.search(self.ui)
        if self.editor.label in self._steps and not self.rows.wanted:
            self._steps[self.editor.label].draw(self.ui)
        for panel in self.editor.panels:
            self.rows.panel(self.ui, panel, self._draw_head_sources if panel.part == "head" else None)

    def _draw_head_sources(self) -> None:
        """Buttons for what the head's text field takes."""
        source = self.studio.document.head.source
        names = {"MakeHuman": "makehuman", "Mannequin": "mannequin"}
        width = (imgui.get_content_region_avail().x - 2 * imgui.get_style().item_spacing.x) / 3
        for label, name in names.items():
            if self.ui.button(label, on=source == name, width=width):
                self.rows.set("head.source", name)
            imgui.same_line()
        help_ = "Choose a mesh: OBJ, PLY, STL, OFF, GLB."
        if self.ui.button("File...", help_, on=source not in names.values(), width=width):
            self.actions.import_head()

    def _measure(self, wall: float) -> None:
        """Keep the figures of a frame that moved; those that take long to find not of every one."""
        grown = self.studio.grown
        self._unmeasured += wall
        if grown is None or self.studio.stage is self._measured:
            return
        self._measured = self.studio.stage
        animation = grown.animation
        measures: dict[str, float] = {}
        if self._unmeasured >= MEASURE_EVERY:
            self._unmeasured = 0.0
            measures = animation.measure()
        stages = animation.timings | self.viewport.renderer.timer.stages
        self.transport.plots.record(animation.time, measures, stages)

    def _record(self) -> None:
        if not self.recorder.recording or self.studio.stage is None:
            return
        with self.studio.reporting() as outcome:
            self.recorder.add(self.viewport.picture())
        if not outcome.good:
            self.recorder.stop()
