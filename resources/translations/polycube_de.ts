<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
  <context>
    <name>Polycube</name>
    <message>
      <source>The analysis that the mesh is for</source>
      <translation>Die Analyse, für die das Netz ist</translation>
    </message>
    <message>
      <source>none</source>
      <translation>keine</translation>
    </message>
    <message>
      <source>an object that is needed, or its document, is gone: {}</source>
      <translation>ein Objekt, das gebraucht wird, oder sein Dokument ist weg: {}</translation>
    </message>
    <message>
      <source>the parts are in different documents</source>
      <translation>die Bauteile sind in verschiedenen Dokumenten</translation>
    </message>
    <message>
      <source>name: not a name but {!r}</source>
      <translation>name: kein Name, sondern {!r}</translation>
    </message>
    <message>
      <source>Hexahedral mesh from shape</source>
      <translation>Hexaedernetz aus Form</translation>
    </message>
    <message>
      <source>{} is in a container of some of the parts; move it out of there</source>
      <translation>{} ist in einem Container einiger der Bauteile; nehmen Sie es dort heraus</translation>
    </message>
    <message>
      <source>the parts are in containers that move them; put them into one App::Part and take that</source>
      <translation>die Bauteile sind in Containern, die sie verschieben; legen Sie sie in ein App::Part und nehmen Sie das</translation>
    </message>
    <message>
      <source>the part that {} was made of is gone</source>
      <translation>das Bauteil, aus dem {} gemacht wurde, ist weg</translation>
    </message>
    <message>
      <source>Hexahedral mesh</source>
      <translation>Hexaedernetz</translation>
    </message>
    <message>
      <source>Mesh parameters</source>
      <translation>Parameter des Netzes</translation>
    </message>
    <message>
      <source>Refinement</source>
      <translation>Verfeinerung</translation>
    </message>
    <message>
      <source>{} is no refinement</source>
      <translation>{} ist keine Verfeinerung</translation>
    </message>
    <message>
      <source>Mesh of the analysis</source>
      <translation>Netz der Analyse</translation>
    </message>
    <message>
      <source>a document object with a shape is needed</source>
      <translation>gebraucht wird ein Dokumentobjekt mit einer Form</translation>
    </message>
    <message>
      <source>analysis is not an analysis object</source>
      <translation>analysis ist kein Analyse-Objekt</translation>
    </message>
    <message>
      <source>{} is in another document than {}</source>
      <translation>{} ist in einem anderen Dokument als {}</translation>
    </message>
    <message>
      <source>{} is no mesh of Polycube</source>
      <translation>{} ist kein Netz von Polycube</translation>
    </message>
    <message>
      <source>an object that is needed, or its document, is gone</source>
      <translation>ein Objekt, das gebraucht wird, oder sein Dokument ist weg</translation>
    </message>
    <message>
      <source>Axes of faces</source>
      <translation>Achsen der Flächen</translation>
    </message>
    <message>
      <source>The direction that each face takes in the block structure of the mesh</source>
      <translation>Die Richtung, die jede Fläche in den Blöcken des Netzes hat</translation>
    </message>
    <message>
      <source>Show on the part</source>
      <translation>Am Bauteil zeigen</translation>
    </message>
    <message>
      <source>Paints each face by its axis; a click on a face gives it another one</source>
      <translation>Färbt jede Fläche nach ihrer Achse; ein Klick auf eine Fläche gibt ihr eine andere</translation>
    </message>
    <message>
      <source>Polycube beside the part</source>
      <translation>Polycube neben dem Teil</translation>
    </message>
    <message>
      <source>Draws what the axes straighten the part into; it takes some seconds more</source>
      <translation>Zeichnet, wozu die Achsen das Teil gerade richten; das dauert einige Sekunden länger</translation>
    </message>
    <message>
      <source>Axes set by hand</source>
      <translation>Von Hand gesetzte Achsen</translation>
    </message>
    <message>
      <source>Automatic</source>
      <translation>Automatisch</translation>
    </message>
    <message>
      <source>Gives up the axes that are selected in the list, all if none is</source>
      <translation>Gibt die Achsen auf, die in der Liste gewählt sind, alle, wenn keine gewählt ist</translation>
    </message>
    <message>
      <source>{} charts, {}, {} turning points, {} CAD edges not captured.</source>
      <translation>{} Felder, {}, {} Wendepunkte, {} CAD-Kanten nicht erfasst.</translation>
    </message>
    <message>
      <source>valid</source>
      <translation>gültig</translation>
    </message>
    <message>
      <source>not valid</source>
      <translation>nicht gültig</translation>
    </message>
    <message>
      <source>No blocks can be made with these axes: give other faces other axes, or make some automatic again.</source>
      <translation>Mit diesen Achsen gibt es keine Blöcke: geben Sie anderen Flächen andere Achsen, oder stellen Sie einige wieder auf automatisch.</translation>
    </message>
    <message>
      <source>{} turns too far for any one axis.</source>
      <translation>{} dreht sich zu weit für eine einzige Achse.</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatisch</translation>
    </message>
    <message>
      <source>reactions {} N carry the loads {} N</source>
      <translation>Auflagerkräfte {} N tragen die Lasten {} N</translation>
    </message>
    <message>
      <source>{}, but for {:.2g} %</source>
      <translation>{}, bis auf {:.2g} %</translation>
    </message>
    <message>
      <source>NOT IN BALANCE by {:.2g} %: {}</source>
      <translation>NICHT IM GLEICHGEWICHT um {:.2g} %: {}</translation>
    </message>
    <message>
      <source>CalculiX is not there; POLYCUBE_CCX=/path/to/ccx names it, or FreeCAD's preferences (FEM, CalculiX)</source>
      <translation>CalculiX ist nicht da; POLYCUBE_CCX=/pfad/zu/ccx nennt es, oder die Einstellungen von FreeCAD (FEM, CalculiX)</translation>
    </message>
    <message>
      <source>POLYCUBE_CCX names no program: {}</source>
      <translation>POLYCUBE_CCX nennt kein Programm: {}</translation>
    </message>
    <message>
      <source>Creates a FEM mesh of hexahedra from the selected solid, or from several</source>
      <translation>Erzeugt ein FEM-Netz aus Hexaedern vom gewählten Volumenkörper oder von mehreren</translation>
    </message>
    <message>
      <source>Solve with CalculiX</source>
      <translation>Mit CalculiX lösen</translation>
    </message>
    <message>
      <source>Solves the active analysis with every load on its hexahedra, by elements C3D20R (first order: C3D8I), and loads the results</source>
      <translation>Löst die aktive Analyse mit jeder Last auf ihren Hexaedern, mit Elementen C3D20R (erste Ordnung: C3D8I), und lädt die Ergebnisse</translation>
    </message>
    <message>
      <source>Cancel</source>
      <translation>Abbrechen</translation>
    </message>
    <message>
      <source>Error of the stresses</source>
      <translation>Fehler der Spannungen</translation>
    </message>
    <message>
      <source>Shows in colours how far the stresses of the solved analysis are off, by an estimate: make the mesh finer where it is red</source>
      <translation>Zeigt in Farben, wie weit die Spannungen der gelösten Analyse nach einer Schätzung abweichen: wo es rot ist, das Netz feiner machen</translation>
    </message>
    <message>
      <source>Guide to hexahedral meshes</source>
      <translation>Anleitung zu Hexaedernetzen</translation>
    </message>
    <message>
      <source>From a first mesh to stresses, with pictures: refinement, what to do when a part is refused, limits</source>
      <translation>Vom ersten Netz bis zu Spannungen, mit Bildern: Verfeinerung, was zu tun ist, wenn ein Teil abgelehnt wird, Grenzen</translation>
    </message>
    <message>
      <source>{}: {:.6g} on the finest mesh; no order is to be seen, the last three differ by {:.2g}{}</source>
      <translation>{}: {:.6g} auf dem feinsten Netz; keine Ordnung ist zu sehen, die letzten drei unterscheiden sich um {:.2g}{}</translation>
    </message>
    <message>
      <source>{}: {:.6g} on the finest mesh, {:.6g} +- {:.2g} in the limit, order {:.1f}</source>
      <translation>{}: {:.6g} auf dem feinsten Netz, {:.6g} +- {:.2g} im Grenzwert, Ordnung {:.1f}</translation>
    </message>
    <message>
      <source>an analysis with a mesh of Polycube is needed</source>
      <translation>gebraucht wird eine Analyse mit einem Netz von Polycube</translation>
    </message>
    <message>
      <source>Convergence series</source>
      <translation>Konvergenzreihe</translation>
    </message>
    <message>
      <source>sizes: neither their number nor a list of sizes but {!r}</source>
      <translation>sizes: weder ihre Zahl noch eine Liste von Größen, sondern {!r}</translation>
    </message>
    <message>
      <source>three different sizes are needed, or more</source>
      <translation>drei verschiedene Größen werden gebraucht, oder mehr</translation>
    </message>
    <message>
      <source>there is no {}</source>
      <translation>es gibt kein {}</translation>
    </message>
    <message>
      <source>a quantity is "max displacement", "max stress", ((x, y, z), "stress") or ("Face3", "displacement")</source>
      <translation>eine Größe ist "max displacement", "max stress", ((x, y, z), "stress") oder ("Face3", "displacement")</translation>
    </message>
    <message>
      <source>{} is not an element of a mesh of order {}: {}</source>
      <translation>{} ist kein Element eines Netzes der Ordnung {}: {}</translation>
    </message>
    <message>
      <source>{} that are the whole section of a bar</source>
      <translation>{}, die der ganze Querschnitt eines Stabs sind</translation>
    </message>
    <message>
      <source>{} at point loads</source>
      <translation>{} an Punktlasten</translation>
    </message>
    <message>
      <source>C3D20 in place of C3D20R in {} of {} cells, against hourglassing: {}</source>
      <translation>C3D20 statt C3D20R in {} von {} Zellen, gegen Hourglassing: {}</translation>
    </message>
    <message>
      <source> and </source>
      <translation> und </translation>
    </message>
    <message>
      <source>no mesher is at hand: this Python has no module {}, and {}</source>
      <translation>kein Vernetzer ist da: dieses Python hat kein Modul {}, und {}</translation>
    </message>
    <message>
      <source>the preference Mesher names neither the program {} nor a Python that has the module: {}</source>
      <translation>die Einstellung Vernetzer nennt weder das Programm {} noch ein Python, das das Modul hat: {}</translation>
    </message>
    <message>
      <source>there is no program {} on PATH; Edit &gt; Preferences &gt; Polycube names one</source>
      <translation>auf PATH ist kein Programm {}; Bearbeiten &gt; Einstellungen &gt; Polycube nennt eines</translation>
    </message>
    <message>
      <source>the shape is empty</source>
      <translation>die Form ist leer</translation>
    </message>
    <message>
      <source>the shape is empty: it has no face</source>
      <translation>die Form ist leer: sie hat keine Fläche</translation>
    </message>
    <message>
      <source>the shape is a shell or loose faces, not a solid</source>
      <translation>die Form ist eine Schale oder lose Flächen, kein Volumenkörper</translation>
    </message>
    <message>
      <source>the shape is a shell or loose faces, not a solid: sewn within {} mm {}</source>
      <translation>die Form ist eine Schale oder lose Flächen, kein Volumenkörper: innerhalb von {} mm vernäht, {}</translation>
    </message>
    <message>
      <source>nothing is left of it</source>
      <translation>bleibt nichts davon übrig</translation>
    </message>
    <message>
      <source>it is open at {}</source>
      <translation>ist sie offen an {}</translation>
    </message>
    <message>
      <source>no shell comes of it</source>
      <translation>wird keine Schale daraus</translation>
    </message>
    <message>
      <source>the shape holds {} solids; one is needed</source>
      <translation>die Form enthält {} Körper; gebraucht wird einer</translation>
    </message>
    <message>
      <source>the shape's faces sew to {} solids; one is needed</source>
      <translation>die Flächen der Form vernähen sich zu {} Körpern; gebraucht wird einer</translation>
    </message>
    <message>
      <source>the shape is open at {}</source>
      <translation>die Form ist offen an {}</translation>
    </message>
    <message>
      <source>more than two faces meet at {}</source>
      <translation>mehr als zwei Flächen treffen sich an {}</translation>
    </message>
    <message>
      <source>the shape is not valid at {} (OpenCASCADE's check)</source>
      <translation>die Form ist nicht gültig an {} (Prüfung von OpenCASCADE)</translation>
    </message>
    <message>
      <source>the solid has no face</source>
      <translation>der Körper hat keine Fläche</translation>
    </message>
    <message>
      <source>the solid is not valid (OpenCASCADE's check)</source>
      <translation>der Körper ist nicht gültig (Prüfung von OpenCASCADE)</translation>
    </message>
    <message>
      <source>the solid's size is not usable: {} mm across</source>
      <translation>die Größe des Körpers ist nicht brauchbar: {} mm</translation>
    </message>
    <message>
      <source>the solid has no volume</source>
      <translation>der Körper hat kein Volumen</translation>
    </message>
    <message>
      <source>the solid is inside out: its volume is negative</source>
      <translation>der Körper ist umgestülpt: sein Volumen ist negativ</translation>
    </message>
    <message>
      <source>the solid intersects itself</source>
      <translation>der Körper durchdringt sich selbst</translation>
    </message>
    <message>
      <source>the solid touches or crosses itself at {}</source>
      <translation>der Körper berührt oder durchdringt sich selbst an {}</translation>
    </message>
    <message>
      <source>{} and others</source>
      <translation>{} und anderen</translation>
    </message>
    <message>
      <source>{} has no usable coordinates</source>
      <translation>{} hat keine brauchbaren Koordinaten</translation>
    </message>
    <message>
      <source>{} has no curve on {}</source>
      <translation>{} hat keine Kurve auf {}</translation>
    </message>
    <message>
      <source>{} bounds {} faces; two are needed</source>
      <translation>{} begrenzt {} Flächen; zwei müssen es sein</translation>
    </message>
    <message>
      <source>OpenCASCADE cannot check the shape</source>
      <translation>OpenCASCADE kann die Form nicht prüfen</translation>
    </message>
    <message>
      <source>OpenCASCADE cannot evaluate the shape</source>
      <translation>OpenCASCADE kann die Form nicht auswerten</translation>
    </message>
    <message>
      <source>OpenCASCADE cannot read the BREP shape</source>
      <translation>OpenCASCADE kann die BREP-Form nicht lesen</translation>
    </message>
    <message>
      <source>OpenCASCADE cannot place the shape</source>
      <translation>OpenCASCADE kann die Form nicht an ihren Ort bringen</translation>
    </message>
    <message>
      <source>OpenCASCADE cannot move the shape</source>
      <translation>OpenCASCADE kann die Form nicht verschieben</translation>
    </message>
    <message>
      <source>OpenCASCADE changes the shape when it moves it</source>
      <translation>OpenCASCADE ändert die Form, wenn es sie verschiebt</translation>
    </message>
    <message>
      <source>OpenCASCADE renumbers the shape when it moves it</source>
      <translation>OpenCASCADE nummeriert die Form um, wenn es sie verschiebt</translation>
    </message>
    <message>
      <source>OpenCASCADE cannot tell where the solids touch</source>
      <translation>OpenCASCADE kann nicht sagen, wo die Körper sich berühren</translation>
    </message>
    <message>
      <source>OpenCASCADE cannot join the solids</source>
      <translation>OpenCASCADE kann die Körper nicht verbinden</translation>
    </message>
    <message>
      <source>a solid falls to pieces</source>
      <translation>ein Körper zerfällt in Stücke</translation>
    </message>
    <message>
      <source>not a BREP shape</source>
      <translation>keine BREP-Form</translation>
    </message>
    <message>
      <source>the BREP shape is cut short or damaged</source>
      <translation>die BREP-Form ist abgeschnitten oder beschädigt</translation>
    </message>
    <message>
      <source>{} and {} overlap: they have {} mm^3 in common</source>
      <translation>{} und {} überschneiden sich: sie haben {} mm^3 gemeinsam</translation>
    </message>
    <message>
      <source>the solids together make no solid: more than two faces meet where they touch along a line only</source>
      <translation>die Körper ergeben zusammen keinen Körper: mehr als zwei Flächen treffen sich, wo sie sich nur entlang einer Linie berühren</translation>
    </message>
    <message>
      <source>the solids together make no solid: their outside touches itself in a point only</source>
      <translation>die Körper ergeben zusammen keinen Körper: ihr Äußeres berührt sich in einem bloßen Punkt</translation>
    </message>
    <message>
      <source>the solids together make no solid</source>
      <translation>die Körper ergeben zusammen keinen Körper</translation>
    </message>
    <message>
      <source>the two solids do not see their common face alike</source>
      <translation>die beiden Körper sehen ihre gemeinsame Fläche nicht gleich</translation>
    </message>
    <message>
      <source>a block of the grid belongs to no solid</source>
      <translation>ein Block des Gitters gehört zu keinem Körper</translation>
    </message>
    <message>
      <source>the grid changes from one solid to another where there is no interface</source>
      <translation>das Gitter geht von einem Körper in einen anderen über, wo keine Berührfläche ist</translation>
    </message>
    <message>
      <source>the mesh does not tell a common face from what is beside it</source>
      <translation>das Netz unterscheidet eine gemeinsame Fläche nicht von dem, was daneben ist</translation>
    </message>
    <message>
      <source>of {} solids that are meshed separately each has axes of its own: look at one of them, or at those that touch</source>
      <translation>von {} Körpern, die getrennt vernetzt werden, hat jeder eigene Achsen: sehen Sie einen davon an, oder die, die sich berühren</translation>
    </message>
    <message>
      <source>of several solids the labels are shown without a map</source>
      <translation>von mehreren Körpern werden die Achsen ohne Abbildung gezeigt</translation>
    </message>
    <message>
      <source>{}; --interfaces separate meshes each solid by itself</source>
      <translation>{}; --interfaces separate vernetzt jeden Körper für sich</translation>
    </message>
    <message>
      <source>{}: the map folds</source>
      <translation>{}: die Abbildung faltet sich</translation>
    </message>
    <message>
      <source>there is no option '{}'</source>
      <translation>es gibt keine Option '{}'</translation>
    </message>
    <message>
      <source>the options are no JSON object</source>
      <translation>die Optionen sind kein JSON-Objekt</translation>
    </message>
    <message>
      <source>{} cannot be read</source>
      <translation>{} ist nicht zu lesen</translation>
    </message>
    <message>
      <source>{}: '{}' is out of range</source>
      <translation>{}: '{}' ist außerhalb des Bereichs</translation>
    </message>
    <message>
      <source>{}: '{}' is not {}</source>
      <translation>{}: '{}' ist nicht {}</translation>
    </message>
    <message>
      <source>a number</source>
      <translation>eine Zahl</translation>
    </message>
    <message>
      <source>a whole number</source>
      <translation>eine ganze Zahl</translation>
    </message>
    <message>
      <source>{} is not a number</source>
      <translation>{} ist keine Zahl</translation>
    </message>
    <message>
      <source>{}: '{}' is neither true nor false</source>
      <translation>{}: '{}' ist weder true noch false</translation>
    </message>
    <message>
      <source>{}: '{}' is not one of {}</source>
      <translation>{}: '{}' ist keines von {}</translation>
    </message>
    <message>
      <source>{} must be greater than 0</source>
      <translation>{} muss größer als 0 sein</translation>
    </message>
    <message>
      <source>{} must be {}, not {}</source>
      <translation>{} muss {} sein, nicht {}</translation>
    </message>
    <message>
      <source>greater than 0</source>
      <translation>größer als 0</translation>
    </message>
    <message>
      <source>at least {}</source>
      <translation>mindestens {}</translation>
    </message>
    <message>
      <source>{} must be at most {}, not {}</source>
      <translation>{} darf höchstens {} sein, nicht {}</translation>
    </message>
    <message>
      <source>give only one of size, hexes and coarsest</source>
      <translation>geben Sie nur eines von size, hexes und coarsest an</translation>
    </message>
    <message>
      <source>coarsest leaves no room for {}</source>
      <translation>coarsest lässt keinen Platz für {}</translation>
    </message>
    <message>
      <source>element_type {} is of order {}, but order {} is asked for</source>
      <translation>element_type {} hat die Ordnung {}, verlangt ist aber Ordnung {}</translation>
    </message>
    <message>
      <source>size {} mm is larger than the part (bounding-box diagonal {} mm)</source>
      <translation>size {} mm ist größer als das Bauteil (Diagonale der Hüllbox {} mm)</translation>
    </message>
    <message>
      <source>that would make about {} hexahedra, more than the {} that are possible</source>
      <translation>das würde etwa {} Hexaeder machen, mehr als die {}, die möglich sind</translation>
    </message>
    <message>
      <source>two directions are needed, those of X and Y, not {}</source>
      <translation>zwei Richtungen werden gebraucht, die von X und Y, nicht {}</translation>
    </message>
    <message>
      <source>a direction is not a number</source>
      <translation>eine Richtung ist keine Zahl</translation>
    </message>
    <message>
      <source>a direction has no length</source>
      <translation>eine Richtung hat keine Länge</translation>
    </message>
    <message>
      <source>X and Y must be at right angles, not {} degrees apart</source>
      <translation>X und Y müssen im rechten Winkel stehen, nicht {} Grad auseinander</translation>
    </message>
    <message>
      <source>the folder for temporary files, TMPDIR, does not exist</source>
      <translation>den Ordner für temporäre Dateien, TMPDIR, gibt es nicht</translation>
    </message>
    <message>
      <source>no folder can be made in that for temporary files, {}; TMPDIR names another</source>
      <translation>in dem für temporäre Dateien, {}, kann kein Ordner gemacht werden; TMPDIR nennt einen anderen</translation>
    </message>
    <message>
      <source>{}: '{}' is not of the form {}</source>
      <translation>{}: '{}' hat nicht die Form {}</translation>
    </message>
    <message>
      <source>1,0,0/0,1,0 (the directions of X and Y)</source>
      <translation>1,0,0/0,1,0 (die Richtungen von X und Y)</translation>
    </message>
    <message>
      <source>Edge4=6, Face1-Face2=3.. or Solid2=3.. (3: exactly, 3..: at least, ..3: at most, 2..5: between)</source>
      <translation>Edge4=6, Face1-Face2=3.. oder Solid2=3.. (3: genau, 3..: mindestens, ..3: höchstens, 2..5: dazwischen)</translation>
    </message>
    <message>
      <source>Face3=0.5, X=2 or Solid2=1.5</source>
      <translation>Face3=0.5, X=2 oder Solid2=1.5</translation>
    </message>
    <message>
      <source>Face7=2, Edge3=1, Vertex2=1 or Solid1=1</source>
      <translation>Face7=2, Edge3=1, Vertex2=1 oder Solid1=1</translation>
    </message>
    <message>
      <source>{}: '{}' has a comma where a point is wanted, as in 0.5</source>
      <translation>{}: '{}' hat ein Komma, wo ein Punkt stehen muss, wie in 0.5</translation>
    </message>
    <message>
      <source>{} does not belong to the solid</source>
      <translation>{} gehört nicht zum Körper</translation>
    </message>
    <message>
      <source>{} does not exist, the part has {}</source>
      <translation>{} gibt es nicht, das Bauteil hat {}</translation>
    </message>
    <message>
      <source>{} faces</source>
      <translation>{} Flächen</translation>
    </message>
    <message>
      <source>{} edges</source>
      <translation>{} Kanten</translation>
    </message>
    <message>
      <source>{} vertices</source>
      <translation>{} Ecken</translation>
    </message>
    <message>
      <source>{} solid</source>
      <translation>{} Körper</translation>
    </message>
    <message>
      <source>{} solids</source>
      <translation>{} Körper</translation>
    </message>
    <message>
      <source>{} is given twice</source>
      <translation>{} ist zweimal angegeben</translation>
    </message>
    <message>
      <source>of the walls of a solid only the least number can be given, as {}=3..</source>
      <translation>für die Wände eines Körpers ist nur die kleinste Zahl möglich, wie {}=3..</translation>
    </message>
    <message>
      <source>there must be 1 element at least, not {}</source>
      <translation>mindestens 1 Element muss es sein, nicht {}</translation>
    </message>
    <message>
      <source>{}: {} leaves no number</source>
      <translation>{}: {} lässt keine Zahl übrig</translation>
    </message>
    <message>
      <source>{}: {} elements are too many</source>
      <translation>{}: {} Elemente sind zu viele</translation>
    </message>
    <message>
      <source>the size of {} must be greater than 0</source>
      <translation>die Größe von {} muss größer als 0 sein</translation>
    </message>
    <message>
      <source>the ratio of {} must be from 0.001 to 1000</source>
      <translation>das Verhältnis von {} muss von 0.001 bis 1000 sein</translation>
    </message>
    <message>
      <source>the levels of {} must be from 1 to {}, not {}</source>
      <translation>die Stufen von {} müssen von 1 bis {} sein, nicht {}</translation>
    </message>
    <message>
      <source>the edge is a seam, which meshes do not follow</source>
      <translation>die Kante ist eine Naht, der Netze nicht folgen</translation>
    </message>
    <message>
      <source>the edge is a point</source>
      <translation>die Kante ist ein Punkt</translation>
    </message>
    <message>
      <source>both faces are the same</source>
      <translation>beide Flächen sind dieselbe</translation>
    </message>
    <message>
      <source>the faces belong to different solids</source>
      <translation>die Flächen gehören zu verschiedenen Körpern</translation>
    </message>
    <message>
      <source>{} cannot be {} all over, it turns against it; {}</source>
      <translation>{} kann nicht überall {} sein, sie dreht sich dagegen; {}</translation>
    </message>
    <message>
      <source>{} cannot be {}, it does not face that way; {}</source>
      <translation>{} kann nicht {} sein, sie zeigt nicht dorthin; {}</translation>
    </message>
    <message>
      <source>it turns too far for any one label</source>
      <translation>sie dreht sich zu weit für eine einzige Achse</translation>
    </message>
    <message>
      <source>it can be {}</source>
      <translation>möglich ist {}</translation>
    </message>
    <message>
      <source>it can be {} or {}</source>
      <translation>möglich ist {} oder {}</translation>
    </message>
    <message>
      <source>it can be {} or {} or {}</source>
      <translation>möglich ist {} oder {} oder {}</translation>
    </message>
    <message>
      <source>{} and {} contradict each other: they are the two sides of one face</source>
      <translation>{} und {} widersprechen sich: sie sind die beiden Seiten einer Fläche</translation>
    </message>
    <message>
      <source>Gmsh makes no usable tetrahedra with any of {} settings; last: {}</source>
      <translation>Gmsh macht mit keiner von {} Einstellungen brauchbare Tetraeder; zuletzt: {}</translation>
    </message>
    <message>
      <source>Gmsh's {} lies on no CAD entity</source>
      <translation>{} von Gmsh liegt auf nichts im CAD</translation>
    </message>
    <message>
      <source>two of Gmsh's entities lie on {}</source>
      <translation>zwei Teile von Gmsh liegen auf {}</translation>
    </message>
    <message>
      <source>a tetrahedron has no volume</source>
      <translation>ein Tetraeder hat kein Volumen</translation>
    </message>
    <message>
      <source>more than two tetrahedra share a facet</source>
      <translation>mehr als zwei Tetraeder teilen eine Seite</translation>
    </message>
    <message>
      <source>a boundary facet of the tetrahedra lies on no CAD face</source>
      <translation>eine äußere Seite der Tetraeder liegt auf keiner CAD-Fläche</translation>
    </message>
    <message>
      <source>some surface triangles bound no tetrahedron</source>
      <translation>einige Dreiecke der Oberfläche begrenzen kein Tetraeder</translation>
    </message>
    <message>
      <source>a piece of {} is no edge of the boundary</source>
      <translation>ein Stück von {} ist keine Kante des Rands</translation>
    </message>
    <message>
      <source>the tetrahedra of a solid are not bounded by its faces</source>
      <translation>die Tetraeder eines Körpers sind nicht von seinen Flächen begrenzt</translation>
    </message>
    <message>
      <source>a solid has no tetrahedra</source>
      <translation>ein Körper hat keine Tetraeder</translation>
    </message>
    <message>
      <source>the tetrahedra leave out {}</source>
      <translation>die Tetraeder lassen {} aus</translation>
    </message>
    <message>
      <source>the boundary of the tetrahedra has another topology than the CAD</source>
      <translation>der Rand der Tetraeder hat eine andere Topologie als das CAD</translation>
    </message>
    <message>
      <source>Gmsh died of signal {}</source>
      <translation>Gmsh starb an Signal {}</translation>
    </message>
    <message>
      <source>Gmsh failed without a word</source>
      <translation>Gmsh scheiterte ohne ein Wort</translation>
    </message>
    <message>
      <source>Gmsh ran longer than {} s</source>
      <translation>Gmsh lief länger als {} s</translation>
    </message>
    <message>
      <source>Gmsh made no tetrahedra</source>
      <translation>Gmsh hat keine Tetraeder gemacht</translation>
    </message>
    <message>
      <source>the program polycube-tet is missing</source>
      <translation>das Programm polycube-tet fehlt</translation>
    </message>
    <message>
      <source>cannot start {}: {}</source>
      <translation>{} ist nicht zu starten: {}</translation>
    </message>
    <message>
      <source>the worker's mesh is cut short</source>
      <translation>das Netz des Hilfsprogramms ist abgeschnitten</translation>
    </message>
    <message>
      <source>the worker wrote no mesh</source>
      <translation>das Hilfsprogramm hat kein Netz geschrieben</translation>
    </message>
    <message>
      <source>cannot write {}</source>
      <translation>nicht zu schreiben ist {}</translation>
    </message>
    <message>
      <source>cannot read the setting {}</source>
      <translation>nicht zu lesen ist die Einstellung {}</translation>
    </message>
    <message>
      <source>the tetrahedra cannot be written: the folder for temporary files (TMPDIR) is full or must not grow</source>
      <translation>die Tetraeder sind nicht zu schreiben: der Ordner für temporäre Dateien (TMPDIR) ist voll oder darf nicht wachsen</translation>
    </message>
    <message>
      <source>the part cannot be written for Gmsh: the folder for temporary files (TMPDIR) is full or must not grow</source>
      <translation>das Bauteil ist für Gmsh nicht zu schreiben: der Ordner für temporäre Dateien (TMPDIR) ist voll oder darf nicht wachsen</translation>
    </message>
    <message>
      <source>no map can have these labels: along one axis each of these charts would have to lie beyond the one before it, and the first beyond the last: {}</source>
      <translation>keine Abbildung kann diese Achsen haben: entlang einer Achse müsste jedes dieser Felder hinter dem vorigen liegen, und das erste hinter dem letzten: {}</translation>
    </message>
    <message>
      <source>{}, with {} set by hand</source>
      <translation>{}, mit {} von Hand gesetzt</translation>
    </message>
    <message>
      <source>the same as one before</source>
      <translation>dasselbe wie eines davor</translation>
    </message>
    <message>
      <source>the charts leave no room along {}</source>
      <translation>die Felder lassen keinen Platz entlang {}</translation>
    </message>
    <message>
      <source>charts {}</source>
      <translation>Felder {}</translation>
    </message>
    <message>
      <source>the charts' planes do not bound a volume</source>
      <translation>die Ebenen der Felder begrenzen kein Volumen</translation>
    </message>
    <message>
      <source>the image of the map has no volume</source>
      <translation>das Bild der Abbildung hat kein Volumen</translation>
    </message>
    <message>
      <source>the blocks do not fill the image of the map</source>
      <translation>die Blöcke füllen das Bild der Abbildung nicht</translation>
    </message>
    <message>
      <source>charts that bound no volume in the image of the map</source>
      <translation>Felder, die im Bild der Abbildung kein Volumen begrenzen</translation>
    </message>
    <message>
      <source>blocks have sides on no chart</source>
      <translation>Blöcke haben Seiten auf keinem Feld</translation>
    </message>
    <message>
      <source>blocks do not fit their neighbours</source>
      <translation>Blöcke passen nicht zu ihren Nachbarn</translation>
    </message>
    <message>
      <source>charts touch, the boundary of the blocks is not a manifold</source>
      <translation>Felder berühren sich, der Rand der Blöcke ist keine Mannigfaltigkeit</translation>
    </message>
    <message>
      <source>the blocks do not have the topology of the solid, Euler characteristic {} instead of {}</source>
      <translation>die Blöcke haben nicht die Topologie des Körpers, Euler-Charakteristik {} statt {}</translation>
    </message>
    <message>
      <source>blocks between the charts' planes are not boxes</source>
      <translation>Blöcke zwischen den Ebenen der Felder sind keine Quader</translation>
    </message>
    <message>
      <source>a block has a side on no chart's sheet</source>
      <translation>ein Block hat eine Seite auf dem Blatt keines Felds</translation>
    </message>
    <message>
      <source>its two ends lie on different charts of one axis</source>
      <translation>ihre beiden Enden liegen auf verschiedenen Feldern einer Achse</translation>
    </message>
    <message>
      <source>a face beside it would be squeezed flat</source>
      <translation>eine Fläche daneben würde flachgedrückt</translation>
    </message>
    <message>
      <source>the tet mesh has no nodes on it</source>
      <translation>das Tetraedernetz hat keine Knoten darauf</translation>
    </message>
    <message>
      <source>smooth, below the feature angle</source>
      <translation>glatt, unter dem Feature-Winkel</translation>
    </message>
    <message>
      <source>the map folds there</source>
      <translation>die Abbildung faltet sich dort</translation>
    </message>
    <message>
      <source>the order of the charts contradicts itself</source>
      <translation>die Reihenfolge der Felder widerspricht sich</translation>
    </message>
    <message>
      <source>constraint {} contradicts the shape of the part</source>
      <translation>die Forderung {} widerspricht der Form des Bauteils</translation>
    </message>
    <message>
      <source>constraints that cannot hold together: {}</source>
      <translation>Forderungen, die nicht zusammen gelten können: {}</translation>
    </message>
    <message>
      <source>the constraints leave no valid mesh: some charts would have to coincide</source>
      <translation>die Forderungen lassen kein gültiges Netz zu: einige Felder müssten zusammenfallen</translation>
    </message>
    <message>
      <source>no valid mesh satisfies {}</source>
      <translation>kein gültiges Netz erfüllt {}</translation>
    </message>
    <message>
      <source>constraint '{}' is not between two charts of one axis</source>
      <translation>die Forderung '{}' ist nicht zwischen zwei Feldern einer Achse</translation>
    </message>
    <message>
      <source>constraint '{}' is on a feature that no sheet reaches</source>
      <translation>die Forderung '{}' ist an einer Stelle, die kein Blatt erreicht</translation>
    </message>
    <message>
      <source>at least {} elements through every wall</source>
      <translation>mindestens {} Elemente durch jede Wand</translation>
    </message>
    <message>
      <source>{} elements through every wall</source>
      <translation>{} Elemente durch jede Wand</translation>
    </message>
    <message>
      <source>an element through the walls of a solid</source>
      <translation>ein Element durch die Wände eines Körpers</translation>
    </message>
    <message>
      <source>{} elements through the walls of a solid</source>
      <translation>{} Elemente durch die Wände eines Körpers</translation>
    </message>
    <message>
      <source>no edge longer than the largest size</source>
      <translation>keine Kante länger als die größte Länge</translation>
    </message>
    <message>
      <source>no cell longer than 10 times its width</source>
      <translation>keine Zelle länger als das 10-fache ihrer Breite</translation>
    </message>
    <message>
      <source>cells that grow by {} at most</source>
      <translation>Zellen, die um höchstens {} wachsen</translation>
    </message>
    <message>
      <source>{} round the bore</source>
      <translation>{} um die Bohrung</translation>
    </message>
    <message>
      <source>{} round the shaft</source>
      <translation>{} um die Welle</translation>
    </message>
    <message>
      <source>{} round the curve</source>
      <translation>{} um die Kurve</translation>
    </message>
    <message>
      <source>{} along the arc</source>
      <translation>{} entlang des Bogens</translation>
    </message>
    <message>
      <source>room for edges</source>
      <translation>Platz für Kanten</translation>
    </message>
    <message>
      <source>room for CAD vertices</source>
      <translation>Platz für CAD-Ecken</translation>
    </message>
    <message>
      <source>the structure of the coarser mesh</source>
      <translation>der Aufbau des gröberen Netzes</translation>
    </message>
    <message>
      <source>the faces of division {} are nowhere opposite each other</source>
      <translation>die Flächen der Teilung {} liegen sich nirgends gegenüber</translation>
    </message>
    <message>
      <source>the grid does not follow the edge of division {}</source>
      <translation>das Gitter folgt der Kante der Teilung {} nicht</translation>
    </message>
    <message>
      <source>division {}: the edge takes {} turns of the grid, it needs as many elements</source>
      <translation>Teilung {}: die Kante nimmt {} Wendungen des Gitters, so viele Elemente braucht sie</translation>
    </message>
    <message>
      <source>the grid does not follow the edge of --bias {}</source>
      <translation>das Gitter folgt der Kante von --bias {} nicht</translation>
    </message>
    <message>
      <source>charts without a quad: {}</source>
      <translation>Felder ohne ein Viereck: {}</translation>
    </message>
    <message>
      <source>the integers of the charts are not in the order of the map</source>
      <translation>die ganzen Zahlen der Felder sind nicht in der Reihenfolge der Abbildung</translation>
    </message>
    <message>
      <source>the integers do not keep the structure of the coarser ones</source>
      <translation>die ganzen Zahlen erhalten den Aufbau der gröberen nicht</translation>
    </message>
    <message>
      <source>the hexahedra do not form a conforming mesh with the topology of the solid</source>
      <translation>die Hexaeder bilden kein passendes Netz mit der Topologie des Körpers</translation>
    </message>
    <message>
      <source>the mesh has another topology than the solid</source>
      <translation>das Netz hat eine andere Topologie als der Körper</translation>
    </message>
    <message>
      <source>the surface of the hexahedral mesh is not the surface of the part</source>
      <translation>die Oberfläche des Hexaedernetzes ist nicht die des Bauteils</translation>
    </message>
    <message>
      <source>padding broke the mesh</source>
      <translation>das Einfügen von Lagen hat das Netz zerbrochen</translation>
    </message>
    <message>
      <source>the mesh handed to padding is not sound</source>
      <translation>das Netz, in das Lagen kommen sollen, ist nicht heil</translation>
    </message>
    <message>
      <source>the mesh does not conform</source>
      <translation>das Netz passt nicht zusammen</translation>
    </message>
    <message>
      <source>a sheet would branch at node {}</source>
      <translation>eine Lage würde sich an Knoten {} verzweigen</translation>
    </message>
    <message>
      <source>a quad is no side of a cell</source>
      <translation>ein Viereck ist keine Seite einer Zelle</translation>
    </message>
    <message>
      <source>{} cells stay inverted</source>
      <translation>{} Zellen bleiben umgestülpt</translation>
    </message>
    <message>
      <source>cells stay inverted, and no CAD edge is left to give up there</source>
      <translation>Zellen bleiben umgestülpt, und keine CAD-Kante ist dort mehr aufzugeben</translation>
    </message>
    <message>
      <source>cells stay inverted after {} attempts</source>
      <translation>Zellen bleiben umgestülpt nach {} Versuchen</translation>
    </message>
    <message>
      <source>a grid of {} cells would take longer than its share of the time</source>
      <translation>ein Gitter von {} Zellen würde länger dauern als sein Teil der Zeit</translation>
    </message>
    <message>
      <source>cells stay flat</source>
      <translation>Zellen bleiben flach</translation>
    </message>
    <message>
      <source>cells without positive Jacobian</source>
      <translation>Zellen ohne positive Jacobi-Determinante</translation>
    </message>
    <message>
      <source>cells lose their volume on the way back to the part's place</source>
      <translation>Zellen verlieren ihr Volumen auf dem Rückweg an den Ort des Bauteils</translation>
    </message>
    <message>
      <source>a cell without size</source>
      <translation>eine Zelle ohne Größe</translation>
    </message>
    <message>
      <source>a node is off its CAD entity</source>
      <translation>ein Knoten ist nicht auf seiner Stelle im CAD</translation>
    </message>
    <message>
      <source>the mesh has no cells</source>
      <translation>das Netz hat keine Zellen</translation>
    </message>
    <message>
      <source>{} cells have a Jacobian that is not positive at an integration point</source>
      <translation>{} Zellen haben eine Jacobi-Determinante, die an einem Integrationspunkt nicht positiv ist</translation>
    </message>
    <message>
      <source>a boundary quad belongs to no cell</source>
      <translation>ein Viereck des Rands gehört zu keiner Zelle</translation>
    </message>
    <message>
      <source>a boundary edge belongs to no cell</source>
      <translation>eine Kante des Rands gehört zu keiner Zelle</translation>
    </message>
    <message>
      <source>no plan is left</source>
      <translation>kein Plan ist übrig</translation>
    </message>
    <message>
      <source>out of memory</source>
      <translation>nicht genug Speicher</translation>
    </message>
    <message>
      <source>internal error</source>
      <translation>interner Fehler</translation>
    </message>
    <message>
      <source>cancelled</source>
      <translation>abgebrochen</translation>
    </message>
    <message>
      <source>out of time</source>
      <translation>die Zeit ist um</translation>
    </message>
    <message>
      <source>stopped by the user</source>
      <translation>vom Benutzer angehalten</translation>
    </message>
    <message>
      <source>the search was ended early; this is the best mesh so far</source>
      <translation>die Suche wurde früh beendet; dies ist das beste Netz bisher</translation>
    </message>
    <message>
      <source>the time limit ended the search; this is the best mesh so far</source>
      <translation>die Zeitgrenze hat die Suche beendet; dies ist das beste Netz bisher</translation>
    </message>
    <message>
      <source>the cells are finer than asked for</source>
      <translation>die Zellen sind feiner als verlangt</translation>
    </message>
    <message>
      <source>the sizes of the cells could be better still: the best integers were not found within the search's nodes</source>
      <translation>die Größen der Zellen könnten noch besser sein: die besten ganzen Zahlen wurden in den Knoten der Suche nicht gefunden</translation>
    </message>
    <message>
      <source>walls have fewer layers than the default: with them the mesh would be poor or none</source>
      <translation>Wände haben weniger Lagen als voreingestellt: mit ihnen wäre das Netz schlecht oder keines</translation>
    </message>
    <message>
      <source>the size alone decides: with the cells that walls and circles ask for the mesh would be poor or none</source>
      <translation>die Größe allein entscheidet: mit den Zellen, die Wände und Kreise verlangen, wäre das Netz schlecht oder keines</translation>
    </message>
    <message>
      <source>{} hexahedra where {} were asked for</source>
      <translation>{} Hexaeder, wo {} verlangt waren</translation>
    </message>
    <message>
      <source>{} has no mesh edges on it</source>
      <translation>{} hat keine Netzkanten</translation>
    </message>
    <message>
      <source>{}: {} through the wall, not {}</source>
      <translation>{}: {} durch die Wand, nicht {}</translation>
    </message>
    <message>
      <source>{}: {} round the curve, not {}</source>
      <translation>{}: {} um die Kurve, nicht {}</translation>
    </message>
    <message>
      <source>{}: {} along the curve, not {}</source>
      <translation>{}: {} entlang der Kurve, nicht {}</translation>
    </message>
    <message>
      <source>{} element</source>
      <translation>{} Element</translation>
    </message>
    <message>
      <source>{} elements</source>
      <translation>{} Elemente</translation>
    </message>
    <message>
      <source>size {}: the cells there are {} mm long</source>
      <translation>Größe {}: die Zellen dort sind {} mm lang</translation>
    </message>
    <message>
      <source>division {}: the mesh has {} elements there</source>
      <translation>Teilung {}: das Netz hat dort {} Elemente</translation>
    </message>
    <message>
      <source>{} and {} more</source>
      <translation>{} und {} weitere</translation>
    </message>
    <message>
      <source>{} more walls with fewer elements through them than asked for</source>
      <translation>{} weitere Wände, durch die weniger Elemente gehen als verlangt</translation>
    </message>
    <message>
      <source>{} more CAD edges with fewer elements along them than their turning asks for</source>
      <translation>{} weitere CAD-Kanten mit weniger Elementen, als ihre Biegung verlangt</translation>
    </message>
    <message>
      <source>{} more sizes of faces that the cells do not have</source>
      <translation>{} weitere Größen von Flächen, die die Zellen nicht haben</translation>
    </message>
    <message>
      <source>{} are one surface to the mesh, as the feature angle asks: the borders of their mesh faces are off the CAD edges between them, and their areas differ from the CAD's</source>
      <translation>{} sind für das Netz eine Fläche, wie es der Feature-Winkel verlangt: die Grenzen ihrer Netzflächen sind nicht auf den CAD-Kanten dazwischen, und ihre Flächeninhalte sind andere als die im CAD</translation>
    </message>
    <message>
      <source>{} mid-edge nodes are off the CAD, where they would spoil a cell: {}</source>
      <translation>{} Kantenmittenknoten sind nicht auf dem CAD, wo sie eine Zelle verderben würden: {}</translation>
    </message>
    <message>
      <source>local refinement: {} cells are divided besides the {} asked for, since only convex regions have templates round them</source>
      <translation>örtliche Verfeinerung: {} Zellen werden außer den {} verlangten geteilt, denn nur um konvexe Gebiete gibt es Vorlagen</translation>
    </message>
    <message>
      <source>local refinement: {} has no cells, as the mesh does not follow it</source>
      <translation>örtliche Verfeinerung: {} hat keine Zellen, da das Netz ihr nicht folgt</translation>
    </message>
    <message>
      <source>the shape is no solid: its {} face is sewn to {} within {} mm</source>
      <translation>die Form ist kein Volumenkörper: ihre {} Fläche ist zu {} vernäht, innerhalb von {} mm</translation>
    </message>
    <message>
      <source>the shape is no solid: its {} faces are sewn to {} within {} mm</source>
      <translation>die Form ist kein Volumenkörper: ihre {} Flächen sind zu {} vernäht, innerhalb von {} mm</translation>
    </message>
    <message>
      <source>one</source>
      <translation>einem</translation>
    </message>
    <message>
      <source>left out beside the solid: {}</source>
      <translation>neben dem Körper weggelassen: {}</translation>
    </message>
    <message>
      <source>{} loose face</source>
      <translation>{} lose Fläche</translation>
    </message>
    <message>
      <source>{} loose faces</source>
      <translation>{} lose Flächen</translation>
    </message>
    <message>
      <source>{} loose edge</source>
      <translation>{} lose Kante</translation>
    </message>
    <message>
      <source>{} loose edges</source>
      <translation>{} lose Kanten</translation>
    </message>
    <message>
      <source>{} loose vertex</source>
      <translation>{} lose Ecke</translation>
    </message>
    <message>
      <source>{} loose vertices</source>
      <translation>{} lose Ecken</translation>
    </message>
    <message>
      <source>the solid is in the shape {} times; it is meshed once</source>
      <translation>der Körper ist {}-mal in der Form; er wird einmal vernetzt</translation>
    </message>
    <message>
      <source>{} and {} meet in {} alone: they have no nodes in common, and no load passes from one to the other</source>
      <translation>{} und {} treffen sich nur in {}: sie haben keine gemeinsamen Knoten, und keine Last geht von einem zum anderen</translation>
    </message>
    <message>
      <source>{} and {} touch in a line or a point alone: they have no nodes in common, and no load passes from one to the other</source>
      <translation>{} und {} berühren sich nur in einer Linie oder einem Punkt: sie haben keine gemeinsamen Knoten, und keine Last geht von einem zum anderen</translation>
    </message>
    <message>
      <source>{} and {} do not touch: they are {} mm apart, and have no common nodes</source>
      <translation>{} und {} berühren sich nicht: sie sind {} mm auseinander und haben keine gemeinsamen Knoten</translation>
    </message>
    <message>
      <source>; did you mean '{}'?</source>
      <translation>; meinten Sie '{}'?</translation>
    </message>
    <message>
      <source>stresses differ most from cell to cell, and a finer mesh changes them most, on {}</source>
      <translation>Spannungen unterscheiden sich von Zelle zu Zelle am meisten, und ein feineres Netz ändert sie am meisten, an {}</translation>
    </message>
    <message>
      <source>stresses inside the cells are off by about {} % in energy, by the estimate of Zienkiewicz and Zhu</source>
      <translation>Spannungen in den Zellen weichen um etwa {} % in der Energie ab, nach der Schätzung von Zienkiewicz und Zhu</translation>
    </message>
    <message>
      <source>{} ({} %, {} % at its worst node)</source>
      <translation>{} ({} %, {} % am schlechtesten Knoten)</translation>
    </message>
    <message>
      <source>stresses inside the cells are off by about {} % in energy, by the estimate of Zienkiewicz and Zhu; most, against the mean stress of the part, on {}</source>
      <translation>Spannungen in den Zellen weichen um etwa {} % in der Energie ab, nach der Schätzung von Zienkiewicz und Zhu; am meisten, gemessen an der mittleren Spannung des Teils, an {}</translation>
    </message>
    <message>
      <source>heat flux</source>
      <translation>Wärmestrom</translation>
    </message>
    <message>
      <source>section print</source>
      <translation>Schnittausgabe</translation>
    </message>
    <message>
      <source>force</source>
      <translation>Kraft</translation>
    </message>
    <message>
      <source>pressure</source>
      <translation>Druck</translation>
    </message>
    <message>
      <source>{}: FreeCAD cannot apply {} to hexahedra</source>
      <translation>{}: FreeCAD kann {} nicht auf Hexaeder anwenden</translation>
    </message>
    <message>
      <source>{}: this FreeCAD's own run of CalculiX leaves it out, polycube.solve does not</source>
      <translation>{}: der eigene CalculiX-Lauf dieses FreeCAD lässt es weg, polycube.solve nicht</translation>
    </message>
    <message>
      <source>{}: the mesh does not capture {}</source>
      <translation>{}: das Netz erfasst {} nicht</translation>
    </message>
    <message>
      <source>part of the {} gets lost</source>
      <translation>ein Teil der Last ({}) geht verloren</translation>
    </message>
    <message>
      <source>all of the {} gets lost</source>
      <translation>die ganze Last ({}) geht verloren</translation>
    </message>
    <message>
      <source>{}: FreeCAD finds {} of the {} mesh faces on {}, {}</source>
      <translation>{}: FreeCAD findet {} der {} Netzflächen auf {}, {}</translation>
    </message>
    <message>
      <source>Element size</source>
      <translation>Elementgröße</translation>
    </message>
    <message>
      <source>Target cells</source>
      <translation>Zahl der Zellen</translation>
    </message>
    <message>
      <source>Element order</source>
      <translation>Elementordnung</translation>
    </message>
    <message>
      <source>Layers in walls</source>
      <translation>Lagen in Wänden</translation>
    </message>
    <message>
      <source>Round circles</source>
      <translation>Um Kreise</translation>
    </message>
    <message>
      <source>Largest size</source>
      <translation>Größte Länge</translation>
    </message>
    <message>
      <source>Sew faces</source>
      <translation>Flächen vernähen</translation>
    </message>
    <message>
      <source>Directions of X, Y</source>
      <translation>Richtungen von X, Y</translation>
    </message>
    <message>
      <source>Local sizes</source>
      <translation>Lokale Größen</translation>
    </message>
    <message>
      <source>Local refinement</source>
      <translation>Örtliche Verfeinerung</translation>
    </message>
    <message>
      <source>1st</source>
      <translation>1.</translation>
    </message>
    <message>
      <source>2nd</source>
      <translation>2.</translation>
    </message>
    <message>
      <source>From {} to {}{}.</source>
      <translation>Von {} bis {}{}.</translation>
    </message>
    <message>
      <source>Polycube: guide</source>
      <translation>Polycube: Anleitung</translation>
    </message>
    <message>
      <source>{} cells with {} {} to {}. A click shows them alone.</source>
      <translation>{} Zellen mit {} {} bis {}. Ein Klick zeigt sie allein.</translation>
    </message>
    <message>
      <source>All-hexahedral FEM meshes of CAD solids</source>
      <translation>FEM-Netze von CAD-Körpern aus lauter Hexaedern</translation>
    </message>
    <message>
      <source>the mesher left nothing that can be read: {}</source>
      <translation>der Vernetzer hat nichts hinterlassen, was zu lesen ist: {}</translation>
    </message>
    <message>
      <source>no message</source>
      <translation>keine Meldung</translation>
    </message>
    <message>
      <source>the mesher was ended by {}: {}</source>
      <translation>der Vernetzer wurde beendet von {}: {}</translation>
    </message>
    <message>
      <source>the mesher ended unexpectedly (status {}): {}</source>
      <translation>der Vernetzer endete unerwartet (Status {}): {}</translation>
    </message>
    <message>
      <source>what {} shows is gone</source>
      <translation>was {} zeigt, ist weg</translation>
    </message>
    <message>
      <source>the mesh does not capture {}</source>
      <translation>das Netz erfasst {} nicht</translation>
    </message>
    <message>
      <source>{} is {}</source>
      <translation>{} ist {}</translation>
    </message>
    <message>
      <source>nothing of the mesh is where it acts</source>
      <translation>wo es wirkt, ist nichts vom Netz</translation>
    </message>
    <message>
      <source>only {:.4g} of {:.4g} N are where the mesh is</source>
      <translation>nur {:.4g} von {:.4g} N sind dort, wo das Netz ist</translation>
    </message>
    <message>
      <source>{}: the solids have common nodes where it acts; make the mesh with Interfaces = separate</source>
      <translation>{}: die Körper haben gemeinsame Knoten, wo es wirkt; machen Sie das Netz mit Interfaces = separate</translation>
    </message>
    <message>
      <source>Scaled Jacobian</source>
      <translation>Skalierte Jacobi-Determinante</translation>
    </message>
    <message>
      <source>Edge ratio</source>
      <translation>Kantenverhältnis</translation>
    </message>
    <message>
      <source>Skew</source>
      <translation>Schiefe</translation>
    </message>
    <message>
      <source>Warpage</source>
      <translation>Verwindung</translation>
    </message>
    <message>
      <source>the part has changed while it was meshed: make the mesh again</source>
      <translation>das Bauteil hat sich während des Vernetzens geändert: machen Sie das Netz noch einmal</translation>
    </message>
    <message>
      <source>{}: the part has changed since it was meshed, loads may get lost: make the mesh again</source>
      <translation>{}: das Bauteil hat sich seit dem Vernetzen geändert, Lasten können verloren gehen: machen Sie das Netz noch einmal</translation>
    </message>
    <message>
      <source>a length</source>
      <translation>eine Länge</translation>
    </message>
    <message>
      <source>an angle</source>
      <translation>ein Winkel</translation>
    </message>
    <message>
      <source>a time</source>
      <translation>eine Zeit</translation>
    </message>
    <message>
      <source>a plain number</source>
      <translation>eine bloße Zahl</translation>
    </message>
    <message>
      <source>unknown option '{}'{}</source>
      <translation>unbekannte Option '{}'{}</translation>
    </message>
    <message>
      <source>; options are </source>
      <translation>; Optionen sind </translation>
    </message>
    <message>
      <source>faces with their axes such as {"Face3": "+X"}</source>
      <translation>Flächen mit ihren Achsen wie {"Face3": "+X"}</translation>
    </message>
    <message>
      <source>faces or axes with their sizes such as {"Face3": 0.5, "X": 2}</source>
      <translation>Flächen oder Achsen mit ihren Größen wie {"Face3": 0.5, "X": 2}</translation>
    </message>
    <message>
      <source>faces, edges or vertices with their levels such as {"Face7": 2, "Edge3": 1}</source>
      <translation>Flächen, Kanten oder Ecken mit ihren Stufen wie {"Face7": 2, "Edge3": 1}</translation>
    </message>
    <message>
      <source>edges with ratios such as {"Edge4": 2.0}</source>
      <translation>Kanten mit Verhältnissen wie {"Edge4": 2.0}</translation>
    </message>
    <message>
      <source>edges or pairs of faces with their elements such as {"Edge4": 6, "Face1-Face2": "3.."}</source>
      <translation>Kanten oder Paare von Flächen mit ihren Elementen wie {"Edge4": 6, "Face1-Face2": "3.."}</translation>
    </message>
    <message>
      <source>faces such as ["Face3", "Face7"]</source>
      <translation>Flächen wie ["Face3", "Face7"]</translation>
    </message>
    <message>
      <source>a pair of directions such as ((1, 0, 0), (0, 1, 0))</source>
      <translation>ein Paar von Richtungen wie ((1, 0, 0), (0, 1, 0))</translation>
    </message>
    <message>
      <source>True or False</source>
      <translation>True oder False</translation>
    </message>
    <message>
      <source>one of {}</source>
      <translation>eines von {}</translation>
    </message>
    <message>
      <source>{} is not {}</source>
      <translation>{} ist nicht {}</translation>
    </message>
    <message>
      <source>{}: {} is given twice</source>
      <translation>{}: {} ist zweimal angegeben</translation>
    </message>
    <message>
      <source>{}: {} is not {}</source>
      <translation>{}: {} ist nicht {}</translation>
    </message>
    <message>
      <source>label '{}' is not of the form Face3=+X</source>
      <translation>Achse '{}' hat nicht die Form Face3=+X</translation>
    </message>
    <message>
      <source>the preference for temporary files names no folder: {}</source>
      <translation>die Einstellung für temporäre Dateien nennt keinen Ordner: {}</translation>
    </message>
    <message>
      <source>Compound of the parts to mesh</source>
      <translation>Verbund der Bauteile zum Vernetzen</translation>
    </message>
    <message>
      <source>Delete</source>
      <translation>Löschen</translation>
    </message>
    <message>
      <source>Other sizes and numbers of cells at places of the part</source>
      <translation>Andere Größen und Zellenzahlen an Stellen des Bauteils</translation>
    </message>
    <message>
      <source>Refine</source>
      <translation>Verfeinern</translation>
    </message>
    <message>
      <source>What</source>
      <translation>Was</translation>
    </message>
    <message>
      <source>Where</source>
      <translation>Wo</translation>
    </message>
    <message>
      <source>Value</source>
      <translation>Wert</translation>
    </message>
    <message>
      <source>A tick has the mesh obey; a double click changes the value; the chosen row's places are selected in the 3D view</source>
      <translation>Mit Haken gilt es für das Netz; ein Doppelklick ändert den Wert; die Stellen der gewählten Zeile sind in der 3D-Ansicht markiert</translation>
    </message>
    <message>
      <source>Add</source>
      <translation>Neu</translation>
    </message>
    <message>
      <source>At the faces, edges or vertices that are selected in the 3D view, or solids in the tree</source>
      <translation>An den Flächen, Kanten oder Ecken, die in der 3D-Ansicht gewählt sind, oder Körpern im Baum</translation>
    </message>
    <message>
      <source>Remove</source>
      <translation>Löschen</translation>
    </message>
    <message>
      <source>From text</source>
      <translation>Aus Text</translation>
    </message>
    <message>
      <source>Makes objects of the text below, as documents of older versions have it</source>
      <translation>Macht Objekte aus dem Text darunter, wie ihn ältere Dokumente haben</translation>
    </message>
    <message>
      <source>Select faces, edges or vertices of the part in the 3D view, then press Add.</source>
      <translation>Wählen Sie Flächen, Kanten oder Ecken des Bauteils in der 3D-Ansicht, dann Neu.</translation>
    </message>
    <message>
      <source>Delete refinement</source>
      <translation>Verfeinerung löschen</translation>
    </message>
    <message>
      <source>Refinements of text</source>
      <translation>Verfeinerungen aus Text</translation>
    </message>
    <message>
      <source>face</source>
      <translation>Fläche</translation>
    </message>
    <message>
      <source>edge</source>
      <translation>Kante</translation>
    </message>
    <message>
      <source>vertex</source>
      <translation>Ecke</translation>
    </message>
    <message>
      <source>solid</source>
      <translation>Körper</translation>
    </message>
    <message>
      <source>Local size</source>
      <translation>Lokale Größe</translation>
    </message>
    <message>
      <source>Another edge length at faces, at edges at most, or in solids</source>
      <translation>Eine andere Kantenlänge an Flächen, an Kanten höchstens, oder in Körpern</translation>
    </message>
    <message>
      <source>Elements at faces, edges or vertices, and no others, divided by three</source>
      <translation>Elemente an Flächen, Kanten oder Ecken, und keine anderen, werden gedrittelt</translation>
    </message>
    <message>
      <source>Divisions</source>
      <translation>Teilungen</translation>
    </message>
    <message>
      <source>Number of elements along edges</source>
      <translation>Zahl der Elemente entlang von Kanten</translation>
    </message>
    <message>
      <source>Layers</source>
      <translation>Lagen</translation>
    </message>
    <message>
      <source>Number of elements between two opposite faces</source>
      <translation>Zahl der Elemente zwischen zwei gegenüberliegenden Flächen</translation>
    </message>
    <message>
      <source>Elements round a bore</source>
      <translation>Elemente um eine Bohrung</translation>
    </message>
    <message>
      <source>Number of elements round cylindrical faces</source>
      <translation>Zahl der Elemente um zylindrische Flächen</translation>
    </message>
    <message>
      <source>Bias</source>
      <translation>Abstufung</translation>
    </message>
    <message>
      <source>Length of the last element along edges over that of the first</source>
      <translation>Länge des letzten Elements entlang von Kanten zu der des ersten</translation>
    </message>
    <message>
      <source>Faces to keep</source>
      <translation>Flächen, die bleiben</translation>
    </message>
    <message>
      <source>Faces none of whose edges is ignored</source>
      <translation>Flächen, von denen keine Kante übergangen wird</translation>
    </message>
    <message>
      <source>Axis of faces</source>
      <translation>Achse von Flächen</translation>
    </message>
    <message>
      <source>The axis that faces take in the blocks</source>
      <translation>Die Achse, die Flächen in den Blöcken haben</translation>
    </message>
    <message>
      <source>there is no refinement '{}'{}</source>
      <translation>es gibt keine Verfeinerung '{}'{}</translation>
    </message>
    <message>
      <source>; there are </source>
      <translation>; es gibt </translation>
    </message>
    <message>
      <source>{}: '{}' is not a length</source>
      <translation>{}: '{}' ist keine Länge</translation>
    </message>
    <message>
      <source>{}: the size must be greater than 0</source>
      <translation>{}: die Größe muss größer als 0 sein</translation>
    </message>
    <message>
      <source>{}: '{}' is not a whole number from 1 to {}</source>
      <translation>{}: '{}' ist keine ganze Zahl von 1 bis {}</translation>
    </message>
    <message>
      <source>{}: '{}' is not a ratio, a number greater than 0</source>
      <translation>{}: '{}' ist kein Verhältnis, eine Zahl größer als 0</translation>
    </message>
    <message>
      <source>{}: '{}' is not a number of elements: 6, 3.., ..4 or 2..5</source>
      <translation>{}: '{}' ist keine Zahl von Elementen: 6, 3.., ..4 oder 2..5</translation>
    </message>
    <message>
      <source> or </source>
      <translation> oder </translation>
    </message>
    <message>
      <source>{}: no {} is chosen</source>
      <translation>{}: nichts ist gewählt, gebraucht wird {}</translation>
    </message>
    <message>
      <source>{}: {} is no {}</source>
      <translation>{}: {} ist nicht, was gebraucht wird: {}</translation>
    </message>
    <message>
      <source>{}: {} has no {} any more</source>
      <translation>{}: {} hat kein {} mehr</translation>
    </message>
    <message>
      <source>{}: {} has no full circle</source>
      <translation>{}: {} hat keinen vollen Kreis</translation>
    </message>
    <message>
      <source>{}: {} faces are needed, not {}</source>
      <translation>{}: {} Flächen werden gebraucht, nicht {}</translation>
    </message>
    <message>
      <source>it belongs to no mesh: drop it onto one in the tree</source>
      <translation>es gehört zu keinem Netz: ziehen Sie es im Baum auf eines</translation>
    </message>
    <message>
      <source>the mesh has no part</source>
      <translation>das Netz hat kein Bauteil</translation>
    </message>
    <message>
      <source>it refers to another part than {}</source>
      <translation>es bezieht sich auf ein anderes Bauteil als {}</translation>
    </message>
    <message>
      <source>edge ratio</source>
      <translation>Kantenverhältnis</translation>
    </message>
    <message>
      <source>skew</source>
      <translation>Schiefe</translation>
    </message>
    <message>
      <source>warpage</source>
      <translation>Verwindung</translation>
    </message>
    <message>
      <source>Result</source>
      <translation>Ergebnis</translation>
    </message>
    <message>
      <source>No mesh yet</source>
      <translation>Noch kein Netz</translation>
    </message>
    <message>
      <source>What bars, colours, threshold and list judge the cells by</source>
      <translation>Wonach Balken, Farben, Schwelle und Liste die Zellen beurteilen</translation>
    </message>
    <message>
      <source>Quality in colours</source>
      <translation>Qualität in Farben</translation>
    </message>
    <message>
      <source>Paints the mesh as the bars: blue is good, red is bad</source>
      <translation>Färbt das Netz wie die Balken: Blau ist gut, Rot ist schlecht</translation>
    </message>
    <message>
      <source>Blocks in colours</source>
      <translation>Blöcke in Farben</translation>
    </message>
    <message>
      <source>Paints each block of the polycube that the cells divide; a cut shows those inside</source>
      <translation>Malt jeden Block des Polycubes an, den die Zellen teilen; ein Schnitt zeigt die im Inneren</translation>
    </message>
    <message>
      <source>Worse than</source>
      <translation>Schlechter als</translation>
    </message>
    <message>
      <source>Shows the cells beyond this value alone</source>
      <translation>Zeigt nur die Zellen jenseits dieses Werts</translation>
    </message>
    <message>
      <source>No cut</source>
      <translation>Kein Schnitt</translation>
    </message>
    <message>
      <source>Cut X</source>
      <translation>Schnitt X</translation>
    </message>
    <message>
      <source>Cut Y</source>
      <translation>Schnitt Y</translation>
    </message>
    <message>
      <source>Cut Z</source>
      <translation>Schnitt Z</translation>
    </message>
    <message>
      <source>Takes the cells on one side of a plane away, whole</source>
      <translation>Nimmt die Zellen auf einer Seite einer Ebene weg, im Ganzen</translation>
    </message>
    <message>
      <source>Lost CAD edges</source>
      <translation>Verlorene CAD-Kanten</translation>
    </message>
    <message>
      <source>Draws the CAD edges that have no mesh edges in red</source>
      <translation>Zeichnet die CAD-Kanten ohne Netzkanten rot</translation>
    </message>
    <message>
      <source>Cell</source>
      <translation>Zelle</translation>
    </message>
    <message>
      <source>Quality</source>
      <translation>Qualität</translation>
    </message>
    <message>
      <source>At</source>
      <translation>An</translation>
    </message>
    <message>
      <source>The worst cells; a click marks one, a double click looks at it closely</source>
      <translation>Die schlechtesten Zellen; ein Klick markiert eine, ein Doppelklick sieht sie aus der Nähe an</translation>
    </message>
    <message>
      <source>{} lost CAD edges</source>
      <translation>{} verlorene CAD-Kanten</translation>
    </message>
    <message>
      <source>The mesh is out of date: press Apply.</source>
      <translation>Das Netz ist nicht aktuell: Anwenden drücken.</translation>
    </message>
    <message>
      <source>{} cells, {} nodes</source>
      <translation>{} Zellen, {} Knoten</translation>
    </message>
    <message>
      <source>Scaled Jacobian: min {}, mean {}</source>
      <translation>Skalierte Jacobi-Determinante: kleinste {}, Mittel {}</translation>
    </message>
    <message>
      <source>Worst cells: </source>
      <translation>Schlechteste Zellen: </translation>
    </message>
    <message>
      <source>faces</source>
      <translation>Flächen</translation>
    </message>
    <message>
      <source>edges</source>
      <translation>Kanten</translation>
    </message>
    <message>
      <source>vertices</source>
      <translation>Ecken</translation>
    </message>
    <message>
      <source>Of the CAD model: </source>
      <translation>Vom CAD-Modell: </translation>
    </message>
    <message>
      <source>inside</source>
      <translation>innen</translation>
    </message>
    <message>
      <source>{} of {} cells shown</source>
      <translation>{} von {} Zellen gezeigt</translation>
    </message>
    <message>
      <source>No cell is like this: nothing is shown</source>
      <translation>Keine Zelle ist so: nichts wird gezeigt</translation>
    </message>
    <message>
      <source>Von Mises stress</source>
      <translation>Von-Mises-Spannung</translation>
    </message>
    <message>
      <source>Temperature</source>
      <translation>Temperatur</translation>
    </message>
    <message>
      <source>Displacement</source>
      <translation>Verschiebung</translation>
    </message>
    <message>
      <source>Error of the stresses, of the part's mean</source>
      <translation>Fehler der Spannungen, gemessen am Mittel des Teils</translation>
    </message>
    <message>
      <source>Difference of the stress from cell to cell</source>
      <translation>Unterschied der Spannung von Zelle zu Zelle</translation>
    </message>
    <message>
      <source>{}: {:.4g} (blue) to {:.4g} {} (red). A double click on {} shows more.</source>
      <translation>{}: {:.4g} (blau) bis {:.4g} {} (rot). Ein Doppelklick auf {} zeigt mehr.</translation>
    </message>
    <message>
      <source>Starting the mesher</source>
      <translation>Vernetzer starten</translation>
    </message>
    <message>
      <source>Reading the part</source>
      <translation>Bauteil lesen</translation>
    </message>
    <message>
      <source>Filling the part with tetrahedra</source>
      <translation>Bauteil mit Tetraedern füllen</translation>
    </message>
    <message>
      <source>Choosing axes of faces</source>
      <translation>Achsen der Flächen wählen</translation>
    </message>
    <message>
      <source>Straightening the part into blocks</source>
      <translation>Bauteil zu Blöcken begradigen</translation>
    </message>
    <message>
      <source>Finding the blocks</source>
      <translation>Blöcke finden</translation>
    </message>
    <message>
      <source>Choosing numbers of cells</source>
      <translation>Zahlen der Zellen wählen</translation>
    </message>
    <message>
      <source>Making hexahedra</source>
      <translation>Hexaeder bilden</translation>
    </message>
    <message>
      <source>Adding layers where faces meet</source>
      <translation>Lagen einfügen, wo Flächen aneinanderstoßen</translation>
    </message>
    <message>
      <source>Moving nodes onto the CAD</source>
      <translation>Knoten auf das CAD bringen</translation>
    </message>
    <message>
      <source>Making elements</source>
      <translation>Elemente bilden</translation>
    </message>
    <message>
      <source>Take the best so far</source>
      <translation>Das beste bisher nehmen</translation>
    </message>
    <message>
      <source>Ends the search for a better mesh</source>
      <translation>Beendet die Suche nach einem besseren Netz</translation>
    </message>
    <message>
      <source>Log of the mesher</source>
      <translation>Protokoll des Vernetzers</translation>
    </message>
    <message>
      <source>{} of about {:.0f} s</source>
      <translation>{} von etwa {:.0f} s</translation>
    </message>
    <message>
      <source>Layout {}: {}</source>
      <translation>Aufteilung {}: {}</translation>
    </message>
    <message>
      <source>all CAD edges</source>
      <translation>alle CAD-Kanten</translation>
    </message>
    <message>
      <source>all but {} CAD edges</source>
      <translation>alle CAD-Kanten bis auf {}</translation>
    </message>
    <message>
      <source>Best so far: valid, {}, worst cell {}</source>
      <translation>Bestes bisher: gültig, {}, schlechteste Zelle {}</translation>
    </message>
    <message>
      <source>the session is at work in another thread</source>
      <translation>die Sitzung arbeitet in einem anderen Thread</translation>
    </message>
    <message>
      <source>the session is closed</source>
      <translation>die Sitzung ist geschlossen</translation>
    </message>
    <message>
      <source>a seam, where a round face closes: the mesh has nodes there by chance only</source>
      <translation>eine Naht, wo eine runde Fläche sich schließt: das Netz hat dort nur zufällig Knoten</translation>
    </message>
    <message>
      <source>the list of parts is empty</source>
      <translation>die Liste der Bauteile ist leer</translation>
    </message>
    <message>
      <source>{} has no shape</source>
      <translation>{} hat keine Form</translation>
    </message>
    <message>
      <source>{} has no solid inside</source>
      <translation>{} enthält keinen Volumenkörper</translation>
    </message>
    <message>
      <source>the solid</source>
      <translation>der Körper</translation>
    </message>
    <message>
      <source>{} is not valid; Part &gt; Check geometry shows why</source>
      <translation>{} ist nicht gültig; Part &gt; Geometrie überprüfen zeigt warum</translation>
    </message>
    <message>
      <source>{} has no volume</source>
      <translation>{} hat kein Volumen</translation>
    </message>
    <message>
      <source>Count cells</source>
      <translation>Zellen zählen</translation>
    </message>
    <message>
      <source>Finds axes of faces and blocks, but makes no mesh, and says how many cells there will be</source>
      <translation>Sucht Achsen der Flächen und Blöcke, macht aber kein Netz, und sagt, wie viele Zellen es werden</translation>
    </message>
    <message>
      <source>0 is automatic: near to {}</source>
      <translation>0 ist automatisch: etwa {}</translation>
    </message>
    <message>
      <source>about {} cells</source>
      <translation>etwa {} Zellen</translation>
    </message>
    <message>
      <source>{} or more, where edges are short</source>
      <translation>{} oder mehr, wo Kanten kurz sind</translation>
    </message>
    <message>
      <source>up to {}, {} without local sizes</source>
      <translation>bis zu {}, {} ohne lokale Größen</translation>
    </message>
    <message>
      <source>Counting ...</source>
      <translation>Zählt ...</translation>
    </message>
    <message>
      <source>{} cells with these axes and sizes</source>
      <translation>{} Zellen mit diesen Achsen und Größen</translation>
    </message>
    <message>
      <source>CalculiX wrote no results</source>
      <translation>CalculiX hat keine Ergebnisse geschrieben</translation>
    </message>
    <message>
      <source>an analysis is needed</source>
      <translation>gebraucht wird eine Analyse</translation>
    </message>
    <message>
      <source>{} has {} solvers of the kind CalculiX Standard; one is needed</source>
      <translation>{} hat {} Löser der Art CalculiX Standard; gebraucht wird einer</translation>
    </message>
    <message>
      <source>no</source>
      <translation>keine</translation>
    </message>
    <message>
      <source>{} is no solver of the kind CalculiX Standard in {}</source>
      <translation>{} ist kein Löser der Art CalculiX Standard in {}</translation>
    </message>
    <message>
      <source>{} has several meshes, one is needed: {}</source>
      <translation>{} hat mehrere Netze, eins wird gebraucht: {}</translation>
    </message>
    <message>
      <source>no folder for CalculiX' files: {}</source>
      <translation>kein Ordner für die Dateien von CalculiX: {}</translation>
    </message>
    <message>
      <source>stresses are {} or {}, not {}</source>
      <translation>Spannungen sind {} oder {}, nicht {}</translation>
    </message>
    <message>
      <source>{}: its cells are not those of its properties; make it again</source>
      <translation>{}: seine Zellen sind nicht die seiner Eigenschaften; machen Sie es noch einmal</translation>
    </message>
    <message>
      <source>FreeCAD could not write the input file</source>
      <translation>FreeCAD konnte die Eingabedatei nicht schreiben</translation>
    </message>
    <message>
      <source>{}: elements can be chosen for meshes of Polycube only</source>
      <translation>{}: Elemente sind nur für Netze von Polycube wählbar</translation>
    </message>
    <message>
      <source>{}: stresses are recovered on meshes of Polycube only</source>
      <translation>{}: Spannungen werden nur auf Netzen von Polycube wiedergewonnen</translation>
    </message>
    <message>
      <source>is written for meshes of Polycube only</source>
      <translation>wird nur für Netze von Polycube geschrieben</translation>
    </message>
    <message>
      <source>means nothing to CalculiX</source>
      <translation>sagt CalculiX nichts</translation>
    </message>
    <message>
      <source>{}: has no effect in an analysis of type {}</source>
      <translation>{}: wirkt nicht in einer Analyse der Art {}</translation>
    </message>
    <message>
      <source>{}: a force is on faces, on edges or on vertices</source>
      <translation>{}: eine Kraft ist auf Flächen, auf Kanten oder auf Ecken</translation>
    </message>
    <message>
      <source>{}: {} has no {}</source>
      <translation>{}: {} hat kein {}</translation>
    </message>
    <message>
      <source>{}: {} of {} is a point</source>
      <translation>{}: {} von {} ist ein Punkt</translation>
    </message>
    <message>
      <source>{}: {} of {} is {}</source>
      <translation>{}: {} von {} ist {}</translation>
    </message>
    <message>
      <source>{}: the mesh does not capture {}; make it again</source>
      <translation>{}: das Netz erfasst {} nicht; machen Sie es noch einmal</translation>
    </message>
    <message>
      <source>the supports leave the part free to move as a whole in {} of 6 ways: displacements mean nothing</source>
      <translation>die Lager lassen dem Teil {} von 6 Bewegungen als Ganzes frei: Verschiebungen sagen nichts aus</translation>
    </message>
    <message>
      <source>{}: shares nodes with a transform constraint</source>
      <translation>{}: hat Knoten mit einer Transformation gemeinsam</translation>
    </message>
    <message>
      <source>it ended with status {}</source>
      <translation>es endete mit Status {}</translation>
    </message>
    <message>
      <source>Element</source>
      <translation>Element</translation>
    </message>
    <message>
      <source>Stresses</source>
      <translation>Spannungen</translation>
    </message>
    <message>
      <source>Default</source>
      <translation>Vorgabe</translation>
    </message>
    <message>
      <source>Recovered from the integration points</source>
      <translation>Aus den Integrationspunkten wiedergewonnen</translation>
    </message>
    <message>
      <source>CalculiX's own</source>
      <translation>CalculiX' eigene</translation>
    </message>
    <message>
      <source>By default C3D20R, with C3D20 where hourglassing threatens or temperatures are looked for; of first order C3D8I</source>
      <translation>Ohne Wahl C3D20R, mit C3D20, wo Hourglassing droht oder Temperaturen gesucht werden; erster Ordnung C3D8I</translation>
    </message>
    <message>
      <source>Recovered ones are closer to the truth, of meshes of second order and linear analyses</source>
      <translation>Wiedergewonnene liegen näher an der Wahrheit, bei Netzen zweiter Ordnung und linearen Analysen</translation>
    </message>
    <message>
      <source>{}: the mesh has no faces on {} of {}</source>
      <translation>{}: das Netz hat keine Flächen auf {} von {}</translation>
    </message>
    <message>
      <source>all</source>
      <translation>allen</translation>
    </message>
    <message>
      <source>{}: it refers to nothing</source>
      <translation>{}: es bezieht sich auf nichts</translation>
    </message>
    <message>
      <source>{}: it needs a round face</source>
      <translation>{}: es braucht eine runde Fläche</translation>
    </message>
    <message>
      <source>{}: the mesh has no cells in what it refers to</source>
      <translation>{}: das Netz hat keine Zellen in dem, worauf es sich bezieht</translation>
    </message>
    <message>
      <source>{}: the material has no density</source>
      <translation>{}: das Material hat keine Dichte</translation>
    </message>
    <message>
      <source>stresses are recovered from the integration points</source>
      <translation>Spannungen sind aus den Integrationspunkten wiedergewonnen</translation>
    </message>
    <message>
      <source>stresses are recovered from the integration points; {:.0f} % are CalculiX's, where the cells are too few or too large for that</source>
      <translation>Spannungen sind aus den Integrationspunkten wiedergewonnen; {:.0f} % sind die von CalculiX, wo die Zellen dafür zu wenige oder zu groß sind</translation>
    </message>
    <message>
      <source>Try other axes of faces, or another frame.</source>
      <translation>Versuchen Sie andere Achsen der Flächen oder andere Richtungen von X und Y.</translation>
    </message>
    <message>
      <source>Try other axes of faces, or a finer size.</source>
      <translation>Versuchen Sie andere Achsen der Flächen oder eine feinere Größe.</translation>
    </message>
    <message>
      <source>Try without one of the demands that are named.</source>
      <translation>Versuchen Sie es ohne eine der genannten Forderungen.</translation>
    </message>
    <message>
      <source>Try a finer size, more effort, or give up smooth edges (Feature angle).</source>
      <translation>Versuchen Sie eine feinere Größe, mehr Aufwand, oder geben Sie glatte Kanten auf (Feature-Winkel).</translation>
    </message>
    <message>
      <source>Try a finer size, more effort, or other axes of faces.</source>
      <translation>Versuchen Sie eine feinere Größe, mehr Aufwand oder andere Achsen der Flächen.</translation>
    </message>
    <message>
      <source>Size</source>
      <translation>Größe</translation>
    </message>
    <message>
      <source>Advanced</source>
      <translation>Weitere</translation>
    </message>
    <message>
      <source>Part:</source>
      <translation>Bauteil:</translation>
    </message>
    <message>
      <source>Analysis:</source>
      <translation>Analyse:</translation>
    </message>
    <message>
      <source>The mesher is running: wait, or stop it with Cancel.</source>
      <translation>Der Vernetzer läuft: warten Sie, oder halten Sie ihn mit Abbrechen an.</translation>
    </message>
    <message>
      <source>The mesher is running already.</source>
      <translation>Der Vernetzer läuft schon.</translation>
    </message>
    <message>
      <source>Nothing has changed since this mesh was made.</source>
      <translation>Seit dieses Netz gemacht wurde, hat sich nichts geändert.</translation>
    </message>
    <message>
      <source>Meshing</source>
      <translation>Vernetzen:</translation>
    </message>
    <message>
      <source>Local sizes make about {} cells of {}: the grid goes through the whole part. Make the mesh?</source>
      <translation>Lokale Größen machen etwa {} Zellen aus {}: das Gitter geht durch das ganze Bauteil. Soll das Netz gemacht werden?</translation>
    </message>
    <message>
      <source>{} holds the mesh {} already. Put the new mesh in its place? The old one stays in the document.</source>
      <translation>{} hat schon das Netz {}. Soll das neue an seine Stelle? Das alte bleibt im Dokument.</translation>
    </message>
    <message>
      <source>Labelling</source>
      <translation>Achsen bestimmen:</translation>
    </message>
    <message>
      <source>there is no part to mesh</source>
      <translation>es gibt kein Bauteil zum Vernetzen</translation>
    </message>
    <message>
      <source>Refused: {}.</source>
      <translation>Abgelehnt: {}.</translation>
    </message>
    <message>
      <source>A finer size</source>
      <translation>Feinere Größe</translation>
    </message>
    <message>
      <source>Other axes of faces</source>
      <translation>Andere Achsen der Flächen</translation>
    </message>
    <message>
      <source>More effort</source>
      <translation>Mehr Aufwand</translation>
    </message>
    <message>
      <source>Smooth edges given up</source>
      <translation>Glatte Kanten aufgeben</translation>
    </message>
    <message>
      <source>the part is gone</source>
      <translation>das Bauteil ist weg</translation>
    </message>
    <message>
      <source>Warning: </source>
      <translation>Warnung: </translation>
    </message>
    <message>
      <source>Meshed: {} cells, {} nodes, worst cell {}.</source>
      <translation>Vernetzt: {} Zellen, {} Knoten, schlechteste Zelle {}.</translation>
    </message>
    <message>
      <source>{} warnings, see the log: {} ...</source>
      <translation>{} Warnungen, siehe Protokoll: {} ...</translation>
    </message>
    <message>
      <source>Taking the mesh</source>
      <translation>Netz übernehmen</translation>
    </message>
    <message>
      <source>The mesh will not have:</source>
      <translation>Das Netz wird nicht haben:</translation>
    </message>
    <message>
      <source>{} more</source>
      <translation>{} weitere</translation>
    </message>
    <message>
      <source>{}: its tolerance is 0; nodes within {:.3g} mm of the other face are tied</source>
      <translation>{}: die Toleranz ist 0; gebunden werden Knoten bis {:.3g} mm vor der anderen Fläche</translation>
    </message>
    <message>
      <source>{}: {} of {} nodes are at the other face and not tied to it; its tolerance may be too small</source>
      <translation>{}: {} von {} Knoten liegen an der anderen Fläche und sind nicht an sie gebunden; die Toleranz ist vielleicht zu klein</translation>
    </message>
    <message>
      <source>{}: {} is no solid of {}</source>
      <translation>{}: {} ist kein Körper von {}</translation>
    </message>
    <message>
      <source>Solid{} of {} has no material</source>
      <translation>Solid{} von {} hat kein Material</translation>
    </message>
    <message>
      <source>{} of {}</source>
      <translation>{} von {}</translation>
    </message>
    <message>
      <source>refers to nothing</source>
      <translation>bezieht sich auf nichts</translation>
    </message>
    <message>
      <source>{} is a container, choose {} of the solid inside</source>
      <translation>{} ist ein Container, wählen Sie {} vom Körper darin</translation>
    </message>
    <message>
      <source>{} has no {} any more</source>
      <translation>{} hat kein {} mehr</translation>
    </message>
    <message>
      <source>{} is not of {}</source>
      <translation>{} ist nicht von {}</translation>
    </message>
    <message>
      <source>{} is a point</source>
      <translation>{} ist ein Punkt</translation>
    </message>
    <message>
      <source>{} will have no mesh edges: {}</source>
      <translation>{} wird keine Netzkanten haben: {}</translation>
    </message>
    <message>
      <source>Task panel</source>
      <translation>Aufgaben</translation>
    </message>
    <message>
      <source>Close the open task panel first.</source>
      <translation>Zuerst den offenen Aufgabenbereich schließen.</translation>
    </message>
    <message>
      <source>The mesher is running for this object. Cancel it first.</source>
      <translation>Der Vernetzer arbeitet an diesem Objekt. Zuerst abbrechen.</translation>
    </message>
    <message>
      <source>{} is the mesh of {}. Delete it?</source>
      <translation>{} ist das Netz von {}. Löschen?</translation>
    </message>
    <message>
      <source>General</source>
      <translation>Allgemein</translation>
    </message>
    <message>
      <source>Mesher</source>
      <translation>Vernetzer</translation>
    </message>
    <message>
      <source>The program polycube, or a Python that has the module _polycube, for a FreeCAD whose own Python has no such module. Empty: polycube on PATH.</source>
      <translation>Das Programm polycube, oder ein Python, das das Modul _polycube hat, für ein FreeCAD, dessen eigenes Python kein solches Modul hat. Leer: polycube auf PATH.</translation>
    </message>
    <message>
      <source>Work</source>
      <translation>Arbeit</translation>
    </message>
    <message>
      <source>Threads</source>
      <translation>Threads</translation>
    </message>
    <message>
      <source>For meshes that do not say how many; the mesh does not depend on it</source>
      <translation>Für Netze, die nicht sagen, wie viele; das Netz hängt nicht davon ab</translation>
    </message>
    <message>
      <source>all cores</source>
      <translation>alle Kerne</translation>
    </message>
    <message>
      <source>Temporary files</source>
      <translation>Temporäre Dateien</translation>
    </message>
    <message>
      <source>A folder for jobs that run; empty: the system's place for temporary files</source>
      <translation>Ein Ordner für Läufe; leer: der Platz des Systems für temporäre Dateien</translation>
    </message>
    <message>
      <source>New meshes in the panel</source>
      <translation>Neue Netze im Aufgabenbereich</translation>
    </message>
    <message>
      <source>Effort</source>
      <translation>Aufwand</translation>
    </message>
    <message>
      <source>quick</source>
      <translation>schnell</translation>
    </message>
    <message>
      <source>normal</source>
      <translation>normal</translation>
    </message>
    <message>
      <source>thorough</source>
      <translation>gründlich</translation>
    </message>
    <message>
      <source>Edge length of the hexahedra. Default: by the part, near to bounding-box diagonal / 20.</source>
      <translation>Kantenlänge der Hexaeder. Ohne Angabe: nach dem Bauteil, etwa Diagonale der Hüllbox / 20.</translation>
    </message>
    <message>
      <source>Hexes</source>
      <translation>Hexaeder</translation>
    </message>
    <message>
      <source>Number of hexahedra to come near to, instead of a size.</source>
      <translation>Zahl der Hexaeder, die etwa erreicht werden soll, statt einer Größe.</translation>
    </message>
    <message>
      <source>Coarsest</source>
      <translation>Gröbstes Netz</translation>
    </message>
    <message>
      <source>The fewest hexahedra that keep the part's shape, instead of a size.</source>
      <translation>Die wenigsten Hexaeder, die die Form des Bauteils erhalten, statt einer Größe.</translation>
    </message>
    <message>
      <source>Order</source>
      <translation>Ordnung</translation>
    </message>
    <message>
      <source>Element order: 1 (8 nodes) or 2 (20 nodes, mid-edge nodes on the CAD).</source>
      <translation>Elementordnung: 1 (8 Knoten) oder 2 (20 Knoten, Kantenmittenknoten auf dem CAD).</translation>
    </message>
    <message>
      <source>Element type</source>
      <translation>Elementtyp</translation>
    </message>
    <message>
      <source>Element of .inp files. Default: C3D8 or C3D20 by order.</source>
      <translation>Element von .inp-Dateien. Ohne Angabe: C3D8 oder C3D20 nach der Ordnung.</translation>
    </message>
    <message>
      <source>How many ways are tried where the first gives no good mesh: bounds the work, not the clock.</source>
      <translation>Wie viele Wege versucht werden, wo der erste kein gutes Netz gibt: begrenzt die Arbeit, nicht die Uhr.</translation>
    </message>
    <message>
      <source>Time limit</source>
      <translation>Zeitgrenze</translation>
    </message>
    <message>
      <source>Stop after this time, with the best mesh so far if there is one. Default: no limit.</source>
      <translation>Nach dieser Zeit aufhören, mit dem besten Netz bisher, wenn es eines gibt. Ohne Angabe: keine Grenze.</translation>
    </message>
    <message>
      <source>Sew</source>
      <translation>Vernähen</translation>
    </message>
    <message>
      <source>Take faces without a solid for one if they sew to it within the file's own tolerance.</source>
      <translation>Flächen ohne Volumenkörper als einen nehmen, wenn sie sich innerhalb der Toleranz der Datei dazu vernähen.</translation>
    </message>
    <message>
      <source>Labels</source>
      <translation>Achsen</translation>
    </message>
    <message>
      <source>Axes of CAD faces set by hand, such as Face3=+X,Face7=-Z.</source>
      <translation>Von Hand gesetzte Achsen von CAD-Flächen, wie Face3=+X,Face7=-Z.</translation>
    </message>
    <message>
      <source>Frame</source>
      <translation>Richtungen</translation>
    </message>
    <message>
      <source>Directions of the labels' X and Y in the part's coordinates, such as 1,0,0/0,1,0. Default: found from the part.</source>
      <translation>Richtungen von X und Y der Achsen in den Koordinaten des Bauteils, wie 1,0,0/0,1,0. Ohne Angabe: aus dem Bauteil.</translation>
    </message>
    <message>
      <source>Min layers</source>
      <translation>Lagen mindestens</translation>
    </message>
    <message>
      <source>Elements through every wall at least. Default: 2 of second order, 3 of first.</source>
      <translation>Elemente durch jede Wand, mindestens. Ohne Angabe: 2 in zweiter Ordnung, 3 in erster.</translation>
    </message>
    <message>
      <source>Per circle</source>
      <translation>Um Kreise</translation>
    </message>
    <message>
      <source>Elements round every full circle at least, arcs in proportion. 0: as the size has it.</source>
      <translation>Elemente um jeden vollen Kreis, mindestens, Bögen im Verhältnis. 0: nach der Größe.</translation>
    </message>
    <message>
      <source>Max size</source>
      <translation>Größte Länge</translation>
    </message>
    <message>
      <source>Edge length that no hexahedron is to exceed. Default: bounding-box diagonal / 15 where no size is given.</source>
      <translation>Kantenlänge, die kein Hexaeder überschreiten soll. Ohne Angabe: Diagonale der Hüllbox / 15, wo keine Größe angegeben ist.</translation>
    </message>
    <message>
      <source>Growth</source>
      <translation>Wachstum</translation>
    </message>
    <message>
      <source>Ratio of the lengths of neighbouring hexahedra, at most, where they grow away from small ones. 1: evenly spaced in every block.</source>
      <translation>Verhältnis der Längen benachbarter Hexaeder, höchstens, wo sie von kleinen weg wachsen. 1: gleichmäßig in jedem Block.</translation>
    </message>
    <message>
      <source>Elements along CAD edges and between opposite CAD faces, such as Edge4=6,Face1-Face2=3.. (at least), ..4 (at most), 2..5; at least through the walls of a solid: Solid2=3..</source>
      <translation>Elemente entlang von CAD-Kanten und zwischen gegenüberliegenden CAD-Flächen, etwa Edge4=6,Face1-Face2=3.. (mindestens), ..4 (höchstens), 2..5; mindestens durch die Wände eines Volumenkörpers: Solid2=3..</translation>
    </message>
    <message>
      <source>Sizes</source>
      <translation>Größen</translation>
    </message>
    <message>
      <source>Other edge lengths at CAD faces, along the labels' axes and of solids, such as Face3=0.5,X=2,Solid2=1.5.</source>
      <translation>Andere Kantenlängen an CAD-Flächen, entlang der Achsen und von Volumenkörpern, etwa Face3=0.5,X=2,Solid2=1.5.</translation>
    </message>
    <message>
      <source>Length of the last hexahedron along a CAD edge over that of the first, such as Edge4=2.0; from its start to its end.</source>
      <translation>Länge des letzten Hexaeders entlang einer CAD-Kante zu der des ersten, wie Edge4=2.0; von ihrem Anfang zu ihrem Ende.</translation>
    </message>
    <message>
      <source>Times that the hexahedra at a CAD face, edge or vertex, and no others, are divided into three along every edge, such as Face7=2,Edge3=1.</source>
      <translation>Wie oft die Hexaeder an einer CAD-Fläche, -Kante oder -Ecke, und nur diese, entlang jeder Kante in drei geteilt werden, etwa Face7=2,Edge3=1.</translation>
    </message>
    <message>
      <source>Interfaces</source>
      <translation>Trennflächen</translation>
    </message>
    <message>
      <source>Where solids touch: one mesh with common nodes (conform), or a mesh of each with nodes of its own, for ties and contact (separate).</source>
      <translation>Wo Volumenkörper sich berühren: ein Netz mit gemeinsamen Knoten (conform), oder von jedem eines mit eigenen Knoten, für Verklebung und Kontakt (separate).</translation>
    </message>
    <message>
      <source>conform</source>
      <translation>gemeinsam</translation>
    </message>
    <message>
      <source>separate</source>
      <translation>getrennt</translation>
    </message>
    <message>
      <source>Feature angle</source>
      <translation>Feature-Winkel</translation>
    </message>
    <message>
      <source>CAD edges that bend less than this are ignored: the faces on both sides share their mesh faces. 0: none.</source>
      <translation>CAD-Kanten mit kleinerem Knick werden übergangen: die Flächen beiderseits teilen sich ihre Netzflächen. 0: keine.</translation>
    </message>
    <message>
      <source>Keep faces</source>
      <translation>Flächen behalten</translation>
    </message>
    <message>
      <source>CAD faces none of whose edges is ignored, such as Face3,Face7. FreeCAD adds those that carry constraints.</source>
      <translation>CAD-Flächen, von denen keine Kante übergangen wird, wie Face3,Face7. FreeCAD fügt die hinzu, die Randbedingungen tragen.</translation>
    </message>
    <message>
      <source>Threads to use; the mesh does not depend on it. 0: all cores.</source>
      <translation>Zahl der Threads; das Netz hängt nicht davon ab. 0: alle Kerne.</translation>
    </message>
    <message>
      <source>Fidelity</source>
      <translation>Treue</translation>
    </message>
    <message>
      <source>Weight of labels that agree with the surface normal.</source>
      <translation>Gewicht von Achsen, die zur Flächennormale passen.</translation>
    </message>
    <message>
      <source>Compactness</source>
      <translation>Kompaktheit</translation>
    </message>
    <message>
      <source>Weight of short borders between labels.</source>
      <translation>Gewicht kurzer Grenzen zwischen Achsen.</translation>
    </message>
  </context>
</TS>
