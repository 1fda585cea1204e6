"""From what a learning platform gives to ``submitted/<student>/<exercise>/``: nobody stops the class, nobody vanishes.

archives   opens what strangers packed, bounded and never by the names inside
platforms  whose file it is, by the names that Moodle and Canvas write
recognise  which exercise a notebook is, whatever its file is called
downloads  the files of a download, with sender, time and what each turned out to be
owners     who in the course the senders are
receipts   what was collected from whom, with the platform's numbers and times
collect    all of it, and one row of a table for everybody
"""
